#pragma once

#include <cstdint>

#include "isophote/scene/scene.h"

namespace isophote {

/// A hash of all that decides a scene's light: geometry, materials, textures, lights, environment, media. Cameras are
/// left out: records made from one view serve another.
std::uint64_t scene_hash(const Scene& scene);

}  // namespace isophote
