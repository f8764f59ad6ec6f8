#include "isophote/load/gltf_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "isophote/core/error.h"

namespace isophote {
namespace {

using nlohmann::json;

enum class Type { boolean, integer, size, number, numbers, string, index, indices, index_map, object, objects };

struct Rule {
  std::string_view key;
  Type type;
  std::string_view target = {};      // index, indices, index_map: JSON pointer of the array that they are of
  std::size_t length = 0;            // numbers
  std::span<const Rule> inner = {};  // object, objects
  bool is_required = false;
};

constexpr Rule numbers(std::string_view key, std::size_t length) { return {key, Type::numbers, {}, length}; }
constexpr Rule index(std::string_view key, std::string_view target) { return {key, Type::index, target}; }
constexpr Rule object(std::string_view key, std::span<const Rule> inner) { return {key, Type::object, {}, 0, inner}; }
constexpr Rule objects(std::string_view key, std::span<const Rule> inner) { return {key, Type::objects, {}, 0, inner}; }
constexpr Rule required(Rule rule) {
  rule.is_required = true;
  return rule;
}

constexpr Rule asset[] = {required({"version", Type::string}), {"minVersion", Type::string}};

constexpr Rule buffer[] = {required({"byteLength", Type::size}), {"uri", Type::string}};
constexpr Rule buffer_view[] = {required(index("buffer", "/buffers")),
                                required({"byteLength", Type::size}),
                                {"byteOffset", Type::size},
                                {"byteStride", Type::size}};
constexpr Rule sparse_indices[] = {required(index("bufferView", "/bufferViews")),
                                   {"byteOffset", Type::integer},
                                   required({"componentType", Type::integer})};
constexpr Rule sparse_values[] = {required(index("bufferView", "/bufferViews")), {"byteOffset", Type::integer}};
constexpr Rule sparse[] = {required({"count", Type::integer}), required(object("indices", sparse_indices)),
                           required(object("values", sparse_values))};
constexpr Rule accessor[] = {index("bufferView", "/bufferViews"),
                             {"byteOffset", Type::size},
                             required({"componentType", Type::integer}),
                             {"normalized", Type::boolean},
                             required({"count", Type::size}),
                             required({"type", Type::string}),
                             object("sparse", sparse)};

constexpr Rule primitive[] = {required({"attributes", Type::index_map, "/accessors"}),
                              index("indices", "/accessors"),
                              index("material", "/materials"),
                              {"mode", Type::integer}};
constexpr Rule mesh[] = {{"name", Type::string}, required(objects("primitives", primitive))};

constexpr std::string_view lights_array = "/extensions/KHR_lights_punctual/lights";
constexpr Rule node_light[] = {required(index("light", lights_array))};
constexpr Rule node_extensions[] = {object("KHR_lights_punctual", node_light)};
constexpr Rule node[] = {{"name", Type::string},
                         index("mesh", "/meshes"),
                         index("camera", "/cameras"),
                         {"children", Type::indices, "/nodes"},
                         numbers("matrix", 16),
                         numbers("translation", 3),
                         numbers("rotation", 4),
                         numbers("scale", 3),
                         object("extensions", node_extensions)};
constexpr Rule scene[] = {{"name", Type::string}, {"nodes", Type::indices, "/nodes"}};

constexpr Rule spot[] = {{"innerConeAngle", Type::number}, {"outerConeAngle", Type::number}};
constexpr Rule light[] = {{"name", Type::string},      required({"type", Type::string}), numbers("color", 3),
                          {"intensity", Type::number}, {"range", Type::number},          object("spot", spot)};
constexpr Rule lights[] = {required(objects("lights", light))};
constexpr Rule root_extensions[] = {object("KHR_lights_punctual", lights)};

constexpr Rule perspective[] = {
    {"aspectRatio", Type::number}, required({"yfov", Type::number}), required({"znear", Type::number})};
constexpr Rule orthographic[] = {required({"xmag", Type::number}), required({"ymag", Type::number}),
                                 required({"zfar", Type::number}), required({"znear", Type::number})};
constexpr Rule camera[] = {{"name", Type::string},
                           required({"type", Type::string}),
                           object("perspective", perspective),
                           object("orthographic", orthographic)};

constexpr Rule image[] = {{"name", Type::string}, {"uri", Type::string}, index("bufferView", "/bufferViews")};
constexpr Rule sampler[] = {{"wrapS", Type::integer}, {"wrapT", Type::integer}};
constexpr Rule texture[] = {{"name", Type::string}, index("source", "/images"), index("sampler", "/samplers")};

constexpr Rule texture_transform[] = {
    numbers("offset", 2), {"rotation", Type::number}, numbers("scale", 2), {"texCoord", Type::integer}};
constexpr Rule texture_info_extensions[] = {object("KHR_texture_transform", texture_transform)};
constexpr Rule texture_info[] = {required(index("index", "/textures")),
                                 {"texCoord", Type::integer},
                                 {"scale", Type::number},
                                 object("extensions", texture_info_extensions)};
constexpr Rule metallic_roughness[] = {numbers("baseColorFactor", 4),
                                       object("baseColorTexture", texture_info),
                                       {"metallicFactor", Type::number},
                                       {"roughnessFactor", Type::number},
                                       object("metallicRoughnessTexture", texture_info)};
constexpr Rule emissive_strength[] = {{"emissiveStrength", Type::number}};
constexpr Rule specular[] = {{"specularFactor", Type::number},
                             object("specularTexture", texture_info),
                             numbers("specularColorFactor", 3),
                             object("specularColorTexture", texture_info)};
constexpr Rule ior[] = {{"ior", Type::number}};
constexpr Rule transmission[] = {{"transmissionFactor", Type::number}, object("transmissionTexture", texture_info)};
constexpr Rule volume[] = {
    {"thicknessFactor", Type::number}, {"attenuationDistance", Type::number}, numbers("attenuationColor", 3)};
constexpr Rule material_extensions[] = {object("KHR_materials_emissive_strength", emissive_strength),
                                        object("KHR_materials_specular", specular), object("KHR_materials_ior", ior),
                                        object("KHR_materials_transmission", transmission),
                                        object("KHR_materials_volume", volume)};
constexpr Rule material[] = {{"name", Type::string},
                             object("pbrMetallicRoughness", metallic_roughness),
                             object("normalTexture", texture_info),
                             numbers("emissiveFactor", 3),
                             object("emissiveTexture", texture_info),
                             {"alphaMode", Type::string},
                             {"alphaCutoff", Type::number},
                             {"doubleSided", Type::boolean},
                             object("extensions", material_extensions)};

constexpr Rule root[] = {required(object("asset", asset)),
                         index("scene", "/scenes"),
                         objects("scenes", scene),
                         objects("nodes", node),
                         objects("meshes", mesh),
                         objects("accessors", accessor),
                         objects("bufferViews", buffer_view),
                         objects("buffers", buffer),
                         objects("materials", material),
                         objects("textures", texture),
                         objects("images", image),
                         objects("samplers", sampler),
                         objects("cameras", camera),
                         object("extensions", root_extensions)};

class Checker {
 public:
  Checker(const json& document, MemoryBudget& budget) : document_(document), budget_(budget) {}

  void check(json& value, std::span<const Rule> rules, const std::string& place) {
    constexpr std::uint64_t bytes_per_object = 1024;  // about what the parser's structs take
    budget_.take(bytes_per_object, place.empty() ? "glTF" : place);
    if (!value.is_object()) fail(place, "must be an object");
    for (auto it = value.begin(); it != value.end();) {
      const bool known =
          std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) { return rule.key == it.key(); });
      it = known ? std::next(it) : value.erase(it);
    }
    for (const Rule& rule : rules) {
      const auto it = value.find(rule.key);
      const std::string inner_place = place.empty() ? std::string(rule.key) : place + "." + std::string(rule.key);
      if (it != value.end())
        check(*it, rule, inner_place);
      else if (rule.is_required)
        fail(inner_place, "is missing");
    }
  }

 private:
  [[noreturn]] static void fail(const std::string& place, std::string_view reason) {
    throw UserError(fmt::format("{}: {}", place, reason));
  }

  void check(json& value, const Rule& rule, const std::string& place) {
    switch (rule.type) {
      case Type::boolean:
        if (!value.is_boolean()) fail(place, "must be true or false");
        break;
      case Type::integer:
        check_unsigned(value, std::numeric_limits<std::int32_t>::max(), place);
        break;
      case Type::size:
        check_unsigned(value, std::numeric_limits<std::int64_t>::max(), place);
        break;
      case Type::number:
        check_number(value, place);
        break;
      case Type::string:
        if (!value.is_string()) fail(place, "must be a string");
        break;
      case Type::index:
        check_index(value, rule, place);
        break;
      case Type::object:
        check(value, rule.inner, place);
        break;
      case Type::index_map:
        if (!value.is_object()) fail(place, "must be an object");
        for (auto& [key, element] : value.items()) check_index(element, rule, place + "." + key);
        break;
      default:
        check_array(value, rule, place);
        break;
    }
  }

  void check_array(json& value, const Rule& rule, const std::string& place) {
    if (!value.is_array()) fail(place, "must be an array");
    if (rule.length > 0 && value.size() != rule.length) fail(place, fmt::format("must have {} numbers", rule.length));
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (rule.type == Type::numbers) check_number(value[i], place);
      if (rule.type == Type::indices) check_index(value[i], rule, place);
      if (rule.type == Type::objects) check(value[i], rule.inner, fmt::format("{}[{}]", place, i));
    }
  }

  static void check_unsigned(const json& value, std::uint64_t largest, const std::string& place) {
    if (!value.is_number_unsigned()) fail(place, "must be a non-negative integer");
    if (value.get<std::uint64_t>() > largest) fail(place, fmt::format("must not exceed {}", largest));
  }

  static void check_number(json& value, const std::string& place) {
    if (!value.is_number()) fail(place, "must be a number");
    const double number = value.get<double>();
    if (!(std::abs(number) <= std::numeric_limits<float>::max())) fail(place, "does not fit a 32-bit float");
    value = number;
  }

  void check_index(const json& value, const Rule& rule, const std::string& place) {
    check_unsigned(value, std::numeric_limits<std::int32_t>::max(), place);
    const std::size_t count = array_size(rule.target);
    if (value.get<std::size_t>() >= count)
      fail(place, fmt::format("{} is out of range: there are {} {}", value.get<std::size_t>(), count,
                              rule.target.substr(rule.target.rfind('/') + 1)));
  }

  std::size_t array_size(std::string_view pointer) {
    if (const auto found = sizes_.find(pointer); found != sizes_.end()) return found->second;
    const json::json_pointer path{std::string(pointer)};
    const bool is_array = document_.contains(path) && document_.at(path).is_array();
    return sizes_[pointer] = is_array ? document_.at(path).size() : 0;
  }

  const json& document_;
  MemoryBudget& budget_;
  std::map<std::string_view, std::size_t> sizes_;
};

}  // namespace

void apply_schema(json& document, MemoryBudget& budget) { Checker(document, budget).check(document, root, ""); }

}  // namespace isophote
