#pragma once

#include <string>
#include <vector>

#include "isophote/load/gltf.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// One setting of a scene file's [film] or [method] table, as text, for whoever knows the keys.
struct Setting {
  std::string table, key, value;  ///< arrays joined by ',' ("512,512"); booleans "on"/"off"
  std::string place;              ///< "FILE:LINE", for messages
};

struct LoadedScene {
  Scene scene;
  std::vector<Setting> settings;
  std::vector<std::string> files;  ///< that it names besides `path`: glTF, buffers, images, environment, grids
};

/// Reads a scene: a glTF file, or a TOML file that names one ([scene] file) and adds an environment
/// ([environment] file, rotation in degrees, intensity), media ([[media]], see README), film and method settings. Paths
/// are relative to the TOML file. Throws UserError `PATH:LINE: reason`.
LoadedScene load_scene(const std::string& path, const Warn& warn);

}  // namespace isophote
