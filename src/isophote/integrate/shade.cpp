#include "isophote/integrate/shade.h"

#include <algorithm>
#include <limits>

#include "isophote/cache/radiance_cache.h"
#include "isophote/integrate/glossy_lobes.h"
#include "isophote/integrate/glossy_rule.h"
#include "isophote/integrate/leak_test.h"

namespace isophote {
namespace {

/// Chances with which the lobes of a point go on.
struct Odds {
  float diffuse = 1, glossy = 1;
};

/// Where chains of cell samples are long, they end by chance. By how much each lobe scatters, so that what goes on is
/// not brighter for it; and both together go on less than once, or chains would branch without end.
Odds chain_odds(const SurfacePoint& point, const Vec3& wo, int depth) {
  constexpr int sure_depth = 3;
  constexpr float least = 0.1f;  // of the diffuse lobe, whose sample others read, where it may weigh more
  if (depth <= sure_depth) return {};
  const float diffuse = max_component(diffuse_albedo(point.bsdf, wo));
  const float glossy =
      point.bsdf.has_glossy() ? max_component(specular_albedo(point.bsdf, dot(wo, point.bsdf.frame.n))) : 0;
  const float both = diffuse + glossy;
  if (!(both > 0)) return {least, 0};
  const float chance = std::clamp(both, 0.5f, 0.9f) / both;
  return {std::max(chance * diffuse, least), chance * glossy};
}

/// The chance with which a glossy ray is followed: always from the camera, by what it can bring further on, and after
/// some events never surely, or paths between bright metals would not end.
float glossy_chance(const FarLight& from, const SurfacePoint& point, const Vec3& wo, const Rgb& throughput, int depth,
                    int events) {
  constexpr int sure_events = 3;
  if (depth == 0) return 1;
  const Rgb albedo = specular_albedo(point.bsdf, dot(wo, point.bsdf.frame.n));
  const float by_light = std::clamp(4 * max_component(throughput * albedo), 0.1f, events < sure_events ? 1.0f : 0.95f);
  return from.cells && point.bsdf.has_diffuse() ? std::min(by_light, chain_odds(point, wo, depth).glossy) : by_light;
}

/// What leaves one point towards `wo`, but for what a glossy ray has yet to find.
struct Left {
  Shaded light;
  float for_ray = 1;  ///< the share of the glossy lobe's indirect light that is a ray's; 0: there is none to follow
};

/// What the glossy lobe reflects by records of incident radiance, which is shown in part; the rest is a ray's.
struct Reflection {
  float share = 0;
  std::optional<Rgb> radiance;
};

Reflection cached_reflection(const World& world, const FarLight& from, const SurfacePoint& point, const Vec3& wo,
                             RayCounts& counts) {
  const Bsdf& bsdf = point.bsdf;
  if (!from.glossy || !from.records || !from.records->radiance() || !bsdf.has_glossy()) return {};
  const CachedLobe cached = cached_lobe(*from.glossy, bsdf, wo);
  if (!(cached.share > 0)) return {};
  const RadianceCache& cache = *from.records->radiance();
  const SurfaceLobe lobe(glossy_lobes(cache.basis()), bsdf, wo, from.glossy->window);
  return {cached.share, cache.reflect(query_at(point), wo, cached.bands, lobe, LeakTest{world, counts})};
}

/// Of the diffuse lobe, and of the glossy one where that is cached; of all lobes where a path takes over.
Left shade_by_caches(const World& world, const FarLight& from, const SurfacePoint& point, const Vec3& wo,
                     float distance, int depth, Sampler& sampler, RayCounts& counts) {
  const auto path = [&](bool covered) -> Left {
    const Scattered s = scatter(world, point, wo, depth, sampler, counts);
    return {{s.direct, s.indirect, s.irradiance, covered}, 0};
  };
  if (depth > 0 && world.max_depth < std::numeric_limits<int>::max()) return path(true);
  std::optional<Rgb> irradiance;
  if (point.bsdf.has_diffuse()) {
    if (from.records) irradiance = from.records->interpolate(query_at(point), LeakTest{world, counts});
    if (!irradiance && from.cells)
      irradiance =
          cell_irradiance(world, from, point, distance, depth, chain_odds(point, wo, depth).diffuse, sampler, counts);
    if (!irradiance) return path(false);
  }
  const Reflection reflection = cached_reflection(world, from, point, wo, counts);
  Left left;
  if (reflection.radiance) left.for_ray = 1 - reflection.share;
  left.light.covered = reflection.radiance || !(reflection.share > 0);
  if (irradiance || left.for_ray == 0)
    left.light.direct = direct_light(world, point, wo, left.for_ray == 0, sampler, counts);
  if (irradiance) {
    left.light.irradiance = *irradiance;
    left.light.indirect = diffuse_albedo(point.bsdf, wo) * *irradiance / pi;
  }
  if (reflection.radiance) left.light.indirect += *reflection.radiance * reflection.share;
  return left;
}

}  // namespace

Shaded shade(const World& world, const FarLight& from, const SurfacePoint& point, const Vec3& wo, float distance,
             int depth, Sampler& sampler, RayCounts& counts) {
  Left left = shade_by_caches(world, from, point, wo, distance, depth, sampler, counts);
  Shaded result = left.light;
  const SurfacePoint* at = &point;
  Vec3 towards = wo;
  Rgb throughput{1.0f};
  GlossyRay ray;
  for (int events = 0; left.for_ray > 0 && at->bsdf.has_glossy(); ++events) {
    const float chance = glossy_chance(from, *at, towards, throughput * left.for_ray, depth, events);
    if (!(sampler.next() < chance)) break;
    throughput = throughput / chance;
    ray = glossy_ray(world, *at, towards, sampler, counts);
    (events == 0 ? result.direct : result.indirect) += throughput * ray.direct;
    throughput *= ray.weight * left.for_ray;
    result.indirect += throughput * ray.next.emission;
    throughput *= ray.next.throughput;
    depth += 1 + ray.next.depth;
    if (depth >= world.max_depth || is_black(throughput)) break;
    if (ray.next.medium_point) result.indirect += throughput * path_radiance(world, ray.next, depth, sampler, counts);
    if (!ray.next.point) break;
    at = &*ray.next.point;
    towards = -ray.next.direction;
    left = shade_by_caches(world, from, *at, towards, ray.next.path_length, depth, sampler, counts);
    result.indirect += throughput * (left.light.direct + left.light.indirect);
    result.covered = result.covered && left.light.covered;
  }
  return result;
}

}  // namespace isophote
