#pragma once

#include <vector>

#include "isophote/load/toml_reader.h"

namespace isophote {

/// The array of tables [[media]] of a scene file, empty where there is none. Throws UserError `NAME:LINE: reason`.
std::vector<SceneToml::Medium> read_media(const TomlReader& reader, const toml::table& root);

}  // namespace isophote
