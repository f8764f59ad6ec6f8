#include "isophote/load/media_toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "isophote/load/largest_extinction.h"
#include "isophote/load/largest_radiance.h"

namespace isophote {
namespace {

constexpr std::size_t most_media = 32;  // a set of them is a word of bits
constexpr float farthest = 1e9f;        // m, as vertices of meshes

class MediumReader {
 public:
  MediumReader(const TomlReader& reader, const toml::table& table) : reader_(reader), table_(table) {}

  SceneToml::Medium read() {
    reader_.refuse_unknown(
        table_, label,
        {"name", "sigma_s", "sigma_a", "density", "albedo", "g", "emission", "box", "mesh", "height", "grid"});
    medium_.place = reader_.place(table_.source());
    if (const toml::node* name = table_.get("name")) medium_.name = text(*name, "name");
    read_coefficients();
    read_g();
    exclude("box", "mesh"), exclude("height", "grid");
    if (const toml::node* box = table_.get("box")) medium_.box = read_box(*box);
    if (const toml::node* mesh = table_.get("mesh"))
      medium_.boundary = {text(*mesh, "mesh"), reader_.place(mesh->source())};
    read_height();
    read_grid();
    return medium_;
  }

 private:
  static constexpr const char* label = "[[media]]";

  /// Refuses tables that have both keys.
  void exclude(const char* a, const char* b) const {
    if (!table_.contains(a) || !table_.contains(b)) return;
    const toml::source_region &at_a = table_.get(a)->source(), &at_b = table_.get(b)->source();
    const bool a_is_later = at_a.begin.line > at_b.begin.line;
    reader_.fail(a_is_later ? at_a : at_b, fmt::format("{} {} and {} exclude each other", label, a, b));
  }

  std::string text(const toml::node& node, const char* key) const {
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty()) reader_.fail(node.source(), fmt::format("{} {} must be text", label, key));
    return *value;
  }

  /// A number, which stands for all channels, or three of them; 0 <= each <= largest.
  Rgbd color(const char* key, double fallback, double largest) const {
    const toml::node* node = table_.get(key);
    if (!node) return Rgbd(fallback);
    const toml::array* array = node->as_array();
    if (array ? array->size() != 3 : !node->is_number())
      reader_.fail(node->source(), fmt::format("{} must be a number or [red, green, blue]", key));
    Rgbd value;
    for (int c = 0; c < 3; ++c) {
      value[c] = reader_.number(array ? (*array)[static_cast<std::size_t>(c)] : *node, key);
      if (!(value[c] >= 0 && value[c] <= largest))
        reader_.fail(node->source(), fmt::format("{} must be from 0 to {:g}", key, largest));
    }
    return value;
  }

  /// A number above 0 that still is one in single precision.
  float positive(const toml::table& table, const char* key, double fallback, double largest) const {
    const double value = reader_.read_number(table, key, fallback);
    if (!(value >= std::numeric_limits<float>::min() && value <= largest))
      reader_.fail(table.get(key)->source(), fmt::format("{} must be above 0, and at most {:g}", key, largest));
    return static_cast<float>(value);
  }

  void read_coefficients() {
    exclude("density", "sigma_s"), exclude("density", "sigma_a");
    exclude("albedo", "sigma_s"), exclude("albedo", "sigma_a");
    medium_.emission = Rgb(color("emission", 0, largest_radiance));
    if (table_.contains("density")) {
      const double density = positive(table_, "density", 1, largest_extinction);
      const Rgbd albedo = color("albedo", 1, 1);
      medium_.scattering = Rgb(albedo * density), medium_.absorption = Rgb((Rgbd(1.0) - albedo) * density);
      return;
    }
    if (const toml::node* albedo = table_.get("albedo"))
      reader_.fail(albedo->source(), fmt::format("{} albedo needs a key 'density'", label));
    medium_.scattering = Rgb(color("sigma_s", 0, largest_extinction / 2));
    medium_.absorption = Rgb(color("sigma_a", 0, largest_extinction / 2));
    if (is_black(medium_.scattering + medium_.absorption) && is_black(medium_.emission))
      reader_.fail(table_.source(), fmt::format("{} needs sigma_s, sigma_a, density or emission above 0", label));
  }

  void read_g() {
    medium_.g = static_cast<float>(reader_.read_number(table_, "g", 0));
    if (!(std::abs(medium_.g) < 1)) reader_.fail(table_.get("g")->source(), "g must be between -1 and 1");
  }

  Vec3 read_point(const toml::node& node) const {
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) fail_box(node);
    Vec3 p;
    for (int a = 0; a < 3; ++a) {
      p[a] = static_cast<float>(reader_.number((*array)[static_cast<std::size_t>(a)], "box"));
      if (!(std::abs(p[a]) <= farthest))
        reader_.fail(node.source(), fmt::format("box must lie within {:g} of the origin", farthest));
    }
    return p;
  }

  [[noreturn]] void fail_box(const toml::node& node) const {
    reader_.fail(node.source(), "box must be two opposite corners, [[x, y, z], [x, y, z]]");
  }

  Box read_box(const toml::node& node) const {
    const toml::array* corners = node.as_array();
    if (!corners || corners->size() != 2) fail_box(node);
    Box box;
    for (const toml::node& corner : *corners) box.extend(read_point(corner));
    const Vec3 size = box.size();
    if (!(std::min({size.x, size.y, size.z}) > 0)) reader_.fail(node.source(), "box has no volume");
    return box;
  }

  void read_height() {
    const toml::table* table = reader_.find_table(table_, "height");
    if (!table) return;
    reader_.refuse_unknown(*table, "[[media]] height", {"base", "scale"});
    if (!table->contains("scale")) reader_.fail(table->source(), "[[media]] height needs a key 'scale'");
    const double base = reader_.read_number(*table, "base", 0);
    if (!(std::abs(base) <= farthest))
      reader_.fail(table->get("base")->source(), fmt::format("base must be within {:g} of 0", farthest));
    medium_.height = {static_cast<float>(base), positive(*table, "scale", 1, farthest)};
  }

  void read_grid() {
    constexpr double largest_scale = 1e30;
    const toml::table* table = reader_.find_table(table_, "grid");
    if (!table) return;
    reader_.refuse_unknown(*table, "[[media]] grid", {"file", "name", "scale"});
    SceneToml::Medium::Grid grid{reader_.read_path(*table, "[[media]] grid"), "density", 1};
    if (const toml::node* name = table->get("name")) grid.name = text(*name, "grid name");
    grid.scale = positive(*table, "scale", 1, largest_scale);
    medium_.grid = grid;
  }

  const TomlReader& reader_;
  const toml::table& table_;
  SceneToml::Medium medium_;
};

}  // namespace

std::vector<SceneToml::Medium> read_media(const TomlReader& reader, const toml::table& root) {
  std::vector<SceneToml::Medium> media;
  const toml::node* node = root.get("media");
  if (!node) return media;
  const toml::array* tables = node->as_array();
  if (!tables) reader.fail(node->source(), "'media' must be an array of tables, [[media]]");
  for (const toml::node& element : *tables) {
    const toml::table* table = element.as_table();
    if (!table) reader.fail(element.source(), "'media' must be an array of tables, [[media]]");
    if (media.size() == most_media) reader.fail(table->source(), fmt::format("over {} media", most_media));
    media.push_back(MediumReader(reader, *table).read());
  }
  return media;
}

}  // namespace isophote
