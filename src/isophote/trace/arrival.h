#pragma once

#include "isophote/trace/path.h"

namespace isophote {

/// What a ray brings. Light met by its first segment is kept apart, for light sampling may have found it too.
struct Arrival {
  FirstPoint first;  ///< `emission` is of what was met after a specular event, and of media on the way
  Rgb lamp;          ///< radiance of a directly sampled emitter at the first segment's end
  Rgb sky;           ///< radiance of the environment's rest there
  Hit hit;           ///< of the first segment; distance infinity: none
};

/// sigma_a (1/m) along a segment that ended at `point` and began in a medium of `inside`, as far as that was known: who
/// meets a solid's back came through that solid.
const Rgb& medium_before(const SurfacePoint& point, const Rgb& inside);

/// Follows a ray, before which `depth` events happened, through specular surfaces. It starts in a medium of absorption
/// `inside` (1/m). Chains have no length limit but world.max_depth; Russian roulette ends each one. Media do not act on
/// the first segment where the caller accounts for what they do there.
Arrival follow(const World& world, const Ray& ray, Rgb inside, int depth, Sampler& sampler, std::uint64_t& kind,
               FirstSegment first_segment = FirstSegment::in_media);

}  // namespace isophote
