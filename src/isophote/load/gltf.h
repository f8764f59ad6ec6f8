#pragma once

#include <functional>
#include <string>
#include <vector>

#include "isophote/scene/scene.h"

namespace isophote {

/// Told one line per thing that was understood only in part.
using Warn = std::function<void(const std::string&)>;

/// Reads a glTF 2.0 file (.gltf or .glb): nodes flattened, instances copied, to world space. Throws UserError
/// `PATH: place: reason` for anything broken, for unsupported required extensions, and for scenes that would not fit in
/// memory (refused before allocating). Adds to `files` the paths of the buffers and images that the file names.
Scene load_gltf(const std::string& path, const Warn& warn, std::vector<std::string>* files = nullptr);

}  // namespace isophote
