#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isophote/load/scene_file.h"

namespace isophote {

/// What a scene file says, before any file that it names is opened.
struct SceneToml {
  struct File {
    std::string path;   ///< as written
    std::string place;  ///< "FILE:LINE"
  };
  struct Environment {
    File file;
    double rotation = 0;   ///< degrees
    double intensity = 1;  ///< factor on every pixel
  };
  File scene;
  std::optional<Environment> environment;
  std::vector<Setting> settings;
};

/// Parses the text of a scene file; `name` stands before messages. Throws UserError `NAME:LINE: reason`.
SceneToml parse_scene_toml(std::string_view text, const std::string& name);

}  // namespace isophote
