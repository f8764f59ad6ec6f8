#pragma once

#include "isophote/integrate/far_light.h"
#include "isophote/trace/path.h"

namespace isophote {

/// Light scattered at a point towards a viewer, the indirect part of its lobes taken from what is known. Split as
/// `Scattered` is.
struct Shaded {
  Rgb direct, indirect, irradiance;
  bool covered = true;  ///< false: somewhere no record served, and a path or a glossy ray went on instead
};

/// Direct light by light sampling; the diffuse lobe's indirect light `from` what is known; the glossy lobe by records
/// of incident radiance as far as glossy_rule.h says, the rest by one ray, at whose hit the same holds. Under a limit
/// of depth a cached value holds the events that are left after the first, so that the cache is read at depth 0 alone
/// and paths go on elsewhere. `depth` counts scattering events before this one, `distance` is the length of the ray
/// that met the point.
Shaded shade(const World& world, const FarLight& from, const SurfacePoint& point, const Vec3& wo, float distance,
             int depth, Sampler& sampler, RayCounts& counts);

/// What a surface point asks the cache.
inline Query query_at(const SurfacePoint& point) { return {point.position, point.shading_normal, point.bsdf.frame.n}; }

}  // namespace isophote
