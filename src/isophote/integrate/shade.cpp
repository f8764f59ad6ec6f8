#include "isophote/integrate/shade.h"

#include <algorithm>
#include <limits>

namespace isophote {
namespace {

/// The chance with which a glossy ray is followed: always from the camera, by weight of the lobe further on.
float glossy_chance(const SurfacePoint& point, const Vec3& wo, int depth) {
  if (depth == 0) return 1;
  return std::clamp(4 * max_component(specular_albedo(point.bsdf, dot(wo, point.bsdf.frame.n))), 0.1f, 1.0f);
}

void add_glossy(const World& world, const RecordCache& cache, const SurfacePoint& point, const Vec3& wo, int depth,
                Sampler& sampler, RayCounts& counts, Shaded& result) {
  const float chance = glossy_chance(point, wo, depth);
  if (sampler.next() >= chance) return;
  const GlossyRay ray = glossy_ray(world, point, wo, sampler, counts);
  result.direct += ray.direct / chance;
  Rgb arriving = ray.next.emission;
  const int next_depth = depth + 1 + ray.next.depth;
  if (ray.next.point && next_depth < world.max_depth) {
    const Shaded next = shade(world, cache, *ray.next.point, -ray.next.direction, next_depth, sampler, counts);
    arriving += ray.next.throughput * (next.direct + next.indirect);
  }
  result.indirect += ray.weight * arriving / chance;
}

}  // namespace

Shaded shade(const World& world, const RecordCache& cache, const SurfacePoint& point, const Vec3& wo, int depth,
             Sampler& sampler, RayCounts& counts) {
  Shaded result;
  if (depth > 0 && world.max_depth < std::numeric_limits<int>::max()) {
    const Scattered path = scatter(world, point, wo, depth, sampler, counts);
    return {path.direct, path.indirect, path.irradiance, true};
  }
  if (point.bsdf.has_diffuse()) {
    const std::optional<Rgb> irradiance = cache.interpolate(query_at(point));
    if (!irradiance) {
      const Scattered path = scatter(world, point, wo, depth, sampler, counts);
      return {path.direct, path.indirect, path.irradiance, false};
    }
    result.direct = direct_diffuse(world, point, wo, sampler, counts);
    result.irradiance = *irradiance;
    result.indirect = diffuse_albedo(point.bsdf, wo) * *irradiance / pi;
  }
  if (point.bsdf.has_glossy()) add_glossy(world, cache, point, wo, depth, sampler, counts, result);
  return result;
}

}  // namespace isophote
