#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "isophote/load/scene_toml.h"

namespace isophote {

/// Reads values of TOML tables and refuses wrong ones, naming the line. `label` is what messages call the table:
/// "[scene]".
class TomlReader {
 public:
  /// `name` of the file stands before messages.
  explicit TomlReader(std::string name) : name_(std::move(name)) {}

  std::string place(const toml::source_region& source) const;
  [[noreturn]] void fail(const toml::source_region& source, const std::string& reason) const;

  void refuse_unknown(const toml::table& table, std::string_view label,
                      std::initializer_list<std::string_view> known) const;
  /// The table under that key, or null.
  const toml::table* find_table(const toml::table& parent, const char* key) const;
  /// The text of the key 'file', which must be there.
  SceneToml::File read_path(const toml::table& table, std::string_view label) const;
  double number(const toml::node& node, std::string_view key) const;
  double read_number(const toml::table& table, const char* key, double fallback) const;

 protected:
  const std::string name_;
};

}  // namespace isophote
