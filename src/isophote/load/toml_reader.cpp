#include "isophote/load/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isophote/load/messages.h"

namespace isophote {

std::string TomlReader::place(const toml::source_region& source) const {
  return fmt::format("{}:{}", name_, source.begin.line);
}

void TomlReader::fail(const toml::source_region& source, const std::string& reason) const {
  throw UserError(place(source) + ": " + one_line(reason));
}

void TomlReader::refuse_unknown(const toml::table& table, std::string_view label,
                                std::initializer_list<std::string_view> known) const {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    if (label.empty())
      fail(key.source(), fmt::format("unknown table or key '{}': there are {}", key.str(), fmt::join(known, ", ")));
    fail(key.source(), fmt::format("unknown key '{}' in {}: there are {}", key.str(), label, fmt::join(known, ", ")));
  }
}

const toml::table* TomlReader::find_table(const toml::table& parent, const char* key) const {
  const toml::node* node = parent.get(key);
  if (node && !node->is_table()) fail(node->source(), fmt::format("'{}' must be a table", key));
  return node ? node->as_table() : nullptr;
}

SceneToml::File TomlReader::read_path(const toml::table& table, std::string_view label) const {
  const toml::node* node = table.get("file");
  if (!node) fail(table.source(), fmt::format("{} needs a key 'file'", label));
  const auto path = node->value_exact<std::string>();
  if (!path || path->empty() || path->find('\0') != path->npos)
    fail(node->source(), fmt::format("{} file must be a path", label));
  return {*path, place(node->source())};
}

double TomlReader::number(const toml::node& node, std::string_view key) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) fail(node.source(), fmt::format("{} must be a number", key));
  return *value;
}

double TomlReader::read_number(const toml::table& table, const char* key, double fallback) const {
  const toml::node* node = table.get(key);
  return node ? number(*node, key) : fallback;
}

}  // namespace isophote
