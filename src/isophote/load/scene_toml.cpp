#include "isophote/load/scene_toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "isophote/load/messages.h"

namespace isophote {
namespace {

class SceneReader {
 public:
  explicit SceneReader(const std::string& name) : name_(name) {}

  SceneToml read(const toml::table& root) {
    refuse_unknown(root, "", {"scene", "environment", "film", "method"});
    SceneToml result;
    result.scene = read_scene(root);
    result.environment = read_environment(root);
    for (const char* table : {"film", "method"}) read_settings(root, table, result.settings);
    return result;
  }

 private:
  std::string place(const toml::source_region& source) const { return fmt::format("{}:{}", name_, source.begin.line); }

  [[noreturn]] void fail(const toml::source_region& source, const std::string& reason) const {
    throw UserError(place(source) + ": " + one_line(reason));
  }

  void refuse_unknown(const toml::table& table, const std::string& name,
                      std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      if (name.empty())
        fail(key.source(), fmt::format("unknown table or key '{}': there are {}", key.str(), fmt::join(known, ", ")));
      fail(key.source(),
           fmt::format("unknown key '{}' in [{}]: there are {}", key.str(), name, fmt::join(known, ", ")));
    }
  }

  /// The table of that name, or null.
  const toml::table* find_table(const toml::table& root, const char* name) const {
    const toml::node* node = root.get(name);
    if (node && !node->is_table()) fail(node->source(), fmt::format("'{}' must be a table", name));
    return node ? node->as_table() : nullptr;
  }

  SceneToml::File read_path(const toml::table& table, const char* name) const {
    const toml::node* node = table.get("file");
    if (!node) fail(table.source(), fmt::format("[{}] needs a key 'file'", name));
    const auto path = node->value_exact<std::string>();
    if (!path || path->empty() || path->find('\0') != path->npos)
      fail(node->source(), fmt::format("[{}] file must be a path", name));
    return {*path, place(node->source())};
  }

  double read_number(const toml::table& table, const char* name, double fallback) const {
    const toml::node* node = table.get(name);
    if (!node) return fallback;
    const auto number = node->is_number() ? node->value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number)) fail(node->source(), fmt::format("{} must be a number", name));
    return *number;
  }

  SceneToml::File read_scene(const toml::table& root) const {
    const toml::table* table = find_table(root, "scene");
    if (!table) throw UserError(name_ + ":1: needs a table [scene] with the key 'file', which names a glTF file");
    refuse_unknown(*table, "scene", {"file"});
    return read_path(*table, "scene");
  }

  std::optional<SceneToml::Environment> read_environment(const toml::table& root) const {
    const toml::table* table = find_table(root, "environment");
    if (!table) return {};
    refuse_unknown(*table, "environment", {"file", "rotation", "intensity"});
    SceneToml::Environment environment;
    environment.file = read_path(*table, "environment");
    environment.rotation = read_number(*table, "rotation", 0);
    environment.intensity = read_number(*table, "intensity", 1);
    if (environment.intensity < 0) fail(table->get("intensity")->source(), "intensity must not be negative");
    return environment;
  }

  std::string setting_text(const toml::node& value, std::string_view key, bool in_array) const {
    if (const auto* text = value.as_string()) return text->get();
    if (const auto* integer = value.as_integer()) return std::to_string(integer->get());
    if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* boolean = value.as_boolean()) return boolean->get() ? "on" : "off";
    const auto* array = value.as_array();
    if (!array || in_array)
      fail(value.source(), fmt::format("{} must be text, a number, true, false, or an array of these", key));
    std::vector<std::string> texts;
    for (const toml::node& element : *array) texts.push_back(setting_text(element, key, true));
    return fmt::format("{}", fmt::join(texts, ","));
  }

  void read_settings(const toml::table& root, const char* name, std::vector<Setting>& settings) const {
    const toml::table* table = find_table(root, name);
    if (!table) return;
    for (const auto& [key, value] : *table)
      settings.push_back({name, std::string(key.str()), setting_text(value, key.str(), false), place(key.source())});
  }

  const std::string& name_;
};

}  // namespace

SceneToml parse_scene_toml(std::string_view text, const std::string& name) {
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw UserError(fmt::format("{}:{}: {}", name, error.source().begin.line, one_line(error.description())));
  }
  return SceneReader(name).read(root);
}

}  // namespace isophote
