#pragma once

#include "isophote/trace/path.h"

namespace isophote {

/// What a ray brings. Light met by its first segment is kept apart, for light sampling may have found it too.
struct Arrival {
  FirstPoint first;  ///< `emission` holds only what was met after a specular event
  Rgb lamp;          ///< radiance of a directly sampled emitter at the first segment's end
  Rgb sky;           ///< radiance of the environment's rest there
  Hit hit;           ///< of the first segment; distance infinity: none
};

/// Follows a ray, before which `depth` events happened, through specular surfaces. Chains have no length limit but
/// world.max_depth; Russian roulette ends each one.
Arrival follow(const World& world, const Ray& ray, int depth, Sampler& sampler, std::uint64_t& kind);

}  // namespace isophote
