#include "isophote/load/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isophote/load/largest_radiance.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

using tinygltf::Value;

constexpr bool srgb = true, linear = false;

const Value* find(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double number(const Value& object, const std::string& key, double fallback) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

Rgbd color(const Value& object, const std::string& key) {
  if (!object.Has(key)) return Rgbd{1.0};
  const Value& v = object.Get(key);
  return {v.Get(0).GetNumberAsDouble(), v.Get(1).GetNumberAsDouble(), v.Get(2).GetNumberAsDouble()};
}

class MaterialReader {
 public:
  MaterialReader(const tinygltf::Material& source, std::string place, TextureTable& textures, const Warn& warn)
      : source_(source), place_(std::move(place)), textures_(textures), warn_(warn) {}

  Material read() {
    m_.name = source_.name;
    m_.double_sided = source_.doubleSided;
    read_alpha();
    read_metallic_roughness();
    m_.normal_texture = use("normalTexture", source_.normalTexture, linear);
    m_.normal_scale = static_cast<float>(source_.normalTexture.scale);
    read_emission();
    read_specular();
    read_transmission();
    return m_;
  }

 private:
  void read_alpha() {
    if (source_.alphaMode == "MASK")
      m_.alpha = Alpha::mask;
    else if (source_.alphaMode == "BLEND")
      m_.alpha = Alpha::blend;
    else if (source_.alphaMode != "OPAQUE")
      throw UserError("alphaMode '" + source_.alphaMode + "' is not one of glTF 2.0");
    m_.alpha_cutoff = static_cast<float>(source_.alphaCutoff);
  }

  void read_metallic_roughness() {
    const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
    const auto& base = pbr.baseColorFactor;
    m_.base_color = unit("baseColorFactor", {base[0], base[1], base[2]});
    m_.base_alpha = unit("baseColorFactor", base[3]);
    m_.base_color_texture = use("baseColorTexture", pbr.baseColorTexture, srgb);
    m_.metallic = unit("metallicFactor", pbr.metallicFactor);
    m_.roughness = unit("roughnessFactor", pbr.roughnessFactor);
    m_.metallic_roughness_texture = use("metallicRoughnessTexture", pbr.metallicRoughnessTexture, linear);
  }

  void read_emission() {
    const auto& factor = source_.emissiveFactor;
    double strength = 1;
    if (const Value* e = find(source_.extensions, "KHR_materials_emissive_strength"))
      strength = number(*e, "emissiveStrength", 1);
    m_.emission =
        non_negative("emissiveFactor times emissiveStrength", Rgbd(factor[0], factor[1], factor[2]) * strength);
    m_.emission_texture = use("emissiveTexture", source_.emissiveTexture, srgb);
  }

  void read_specular() {
    if (const Value* e = find(source_.extensions, "KHR_materials_specular")) {
      m_.specular = unit("specularFactor", number(*e, "specularFactor", 1));
      m_.specular_color = non_negative("specularColorFactor", color(*e, "specularColorFactor"));
      m_.specular_texture = use(*e, "specularTexture", linear);
      m_.specular_color_texture = use(*e, "specularColorTexture", srgb);
    }
    if (const Value* e = find(source_.extensions, "KHR_materials_ior")) {
      constexpr double largest = 1000;
      const double ior = number(*e, "ior", 1.5);
      if (!(ior == 0 || (ior >= 1 && ior <= largest)))
        throw UserError(fmt::format("ior {} is neither 0 nor between 1 and {}", ior, largest));
      m_.ior = static_cast<float>(ior);
    }
  }

  void read_transmission() {
    if (const Value* e = find(source_.extensions, "KHR_materials_transmission")) {
      m_.transmission = unit("transmissionFactor", number(*e, "transmissionFactor", 0));
      m_.transmission_texture = use(*e, "transmissionTexture", linear);
      constexpr float smooth = 0.01f;
      if (m_.transmission > 0 && (m_.roughness > smooth || m_.metallic_roughness_texture.texture >= 0))
        warn_(place_ + ": rough transmission is rendered smooth");
    }
    if (const Value* e = find(source_.extensions, "KHR_materials_volume")) {
      m_.solid = number(*e, "thicknessFactor", 0) > 0;
      m_.attenuation_color = unit("attenuationColor", color(*e, "attenuationColor"));
      const double distance = number(*e, "attenuationDistance", infinity);
      if (!(distance > 0)) throw UserError("attenuationDistance must be positive");
      m_.attenuation_distance = static_cast<float>(distance);
    }
  }

  float unit(const char* key, double value) {
    if (value < 0 || value > 1) warn_(fmt::format("{}: {} lies outside [0, 1] and is clamped", place_, key));
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
  }
  Rgb unit(const char* key, const Rgbd& value) { return {unit(key, value.r), unit(key, value.g), unit(key, value.b)}; }

  static Rgb non_negative(const char* key, const Rgbd& value) {
    const Rgb rounded(value);
    if (!is_finite(rounded) || std::min({rounded.r, rounded.g, rounded.b}) < 0 ||
        max_component(rounded) > largest_radiance)
      throw UserError(fmt::format("{} must be a number between 0 and {:g}", key, largest_radiance));
    return rounded;
  }

  TextureUse use(const Value& extension, const char* key, bool is_srgb) {
    if (!extension.Has(key)) return {};
    const Value& info = extension.Get(key);
    const Value* transform = nullptr;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
      transform = &info.Get("extensions").Get("KHR_texture_transform");
    const int uv_set = info.Has("texCoord") ? info.Get("texCoord").GetNumberAsInt() : 0;
    return use(key, info.Get("index").GetNumberAsInt(), uv_set, transform, is_srgb);
  }

  template <class Info>
  TextureUse use(const char* key, const Info& info, bool is_srgb) {
    if (info.index < 0) return {};
    return use(key, info.index, info.texCoord, find(info.extensions, "KHR_texture_transform"), is_srgb);
  }

  TextureUse use(const char* key, int texture, int uv_set, const Value* transform, bool is_srgb) {
    return with_place(key, [&] {
      TextureUse result;
      result.uv_set = uv_set;
      if (transform) apply_transform(*transform, result);
      if (result.uv_set > 1) throw UserError(fmt::format("texCoord {}: only 0 and 1 are supported", result.uv_set));
      result.texture = textures_.id(texture, is_srgb);
      return result;
    });
  }

  /// KHR_texture_transform: scale, then rotate, then move. Positive rotations turn u away from v, whose axis points
  /// down.
  static void apply_transform(const Value& transform, TextureUse& result) {
    if (transform.Has("texCoord")) result.uv_set = transform.Get("texCoord").GetNumberAsInt();
    const auto pair = [&](const char* key, int i, double fallback) {
      return transform.Has(key) ? transform.Get(key).Get(i).GetNumberAsDouble() : fallback;
    };
    const double angle = number(transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
    const double su = pair("scale", 0, 1), sv = pair("scale", 1, 1);
    const double matrix[] = {c * su, s * sv, pair("offset", 0, 0), -s * su, c * sv, pair("offset", 1, 0)};
    constexpr double largest = 1e6;  // beyond, a float has no fraction left to find a texel with
    for (std::size_t i = 0; i < result.matrix.size(); ++i) {
      if (!(std::abs(matrix[i]) <= largest)) throw UserError("KHR_texture_transform: a number exceeds a million");
      result.matrix[i] = static_cast<float>(matrix[i]);
    }
  }

  const tinygltf::Material& source_;
  std::string place_;
  TextureTable& textures_;
  const Warn& warn_;
  Material m_;
};

}  // namespace

Material read_material(const GltfFile& file, std::size_t index, TextureTable& textures, const Warn& warn) {
  const tinygltf::Material& source = file.model.materials[index];
  const std::string place = place_name("materials", index, source.name);
  return with_place(place, [&] { return MaterialReader(source, place, textures, warn).read(); });
}

std::array<const TextureUse*, 7> texture_uses(const Material& m) {
  return {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,      &m.emission_texture,
          &m.specular_texture,   &m.specular_color_texture,     &m.transmission_texture};
}

}  // namespace isophote
