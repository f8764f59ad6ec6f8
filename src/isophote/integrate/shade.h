#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/trace/path.h"

namespace isophote {

/// Light scattered at a point towards a viewer, its diffuse indirect part read from a cache. Split as `Scattered` is.
struct Shaded {
  Rgb direct, indirect, irradiance;
  bool covered = true;  ///< false: somewhere no record served, and the sample went on as one unbiased path
};

/// Direct light by light sampling; the diffuse lobe's indirect light from `cache`; the glossy lobe by one ray, at whose
/// hit the same rule applies. Under a limit of depth a cached value holds the events that are left after the first, so
/// that the cache is read at depth 0 alone and paths go on elsewhere. `depth` counts scattering events before this one.
Shaded shade(const World& world, const RecordCache& cache, const SurfacePoint& point, const Vec3& wo, int depth,
             Sampler& sampler, RayCounts& counts);

/// What a surface point asks the cache.
inline Query query_at(const SurfacePoint& point) { return {point.position, point.shading_normal, point.bsdf.frame.n}; }

}  // namespace isophote
