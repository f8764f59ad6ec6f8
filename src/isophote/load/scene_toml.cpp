#include "isophote/load/scene_toml.h"

#include <fmt/format.h>

#include "isophote/load/media_toml.h"
#include "isophote/load/messages.h"
#include "isophote/load/toml_reader.h"

namespace isophote {
namespace {

class SceneReader : public TomlReader {
 public:
  using TomlReader::TomlReader;

  SceneToml read(const toml::table& root) {
    refuse_unknown(root, "", {"scene", "environment", "media", "film", "method"});
    SceneToml result;
    result.scene = read_scene(root);
    result.environment = read_environment(root);
    result.media = read_media(*this, root);
    for (const char* table : {"film", "method"}) read_settings(root, table, result.settings);
    return result;
  }

 private:
  SceneToml::File read_scene(const toml::table& root) const {
    const toml::table* table = find_table(root, "scene");
    if (!table) throw UserError(name_ + ":1: needs a table [scene] with the key 'file', which names a glTF file");
    refuse_unknown(*table, "[scene]", {"file"});
    return read_path(*table, "[scene]");
  }

  std::optional<SceneToml::Environment> read_environment(const toml::table& root) const {
    const toml::table* table = find_table(root, "environment");
    if (!table) return {};
    refuse_unknown(*table, "[environment]", {"file", "rotation", "intensity"});
    SceneToml::Environment environment;
    environment.file = read_path(*table, "[environment]");
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
};

}  // namespace

std::string resolve(const SceneToml::File& file, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / file.path;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UserError(fmt::format("{}: no file '{}'", file.place, one_line(path.string())));
  return path.string();
}

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
