#include "isophote/integrate/gather.h"

#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

Rgb scattered_radiance(const World& world, const RecordCache* cache, const SurfacePoint& point, const Vec3& wo,
                       int depth, Sampler& sampler, RayCounts& counts) {
  if (cache) {
    const Shaded s = shade(world, *cache, point, wo, depth, sampler, counts);
    return s.direct + s.indirect;
  }
  const Scattered s = scatter(world, point, wo, depth, sampler, counts);
  return s.direct + s.indirect;
}

GatherSample gather_sample(const World& world, const RecordCache* cache, const Ray& ray, const Rgb& medium,
                           Sampler& sampler, RayCounts& counts) {
  const FirstPoint hit = first_point(world, ray, false, sampler, counts.gather, medium);
  GatherSample sample{ray.direction, hit.first_distance, hit.emission, hit.first_normal, hit.first_mesh};
  const int depth = 1 + hit.depth;
  if (hit.point && depth < world.max_depth)
    sample.radiance +=
        hit.throughput * scattered_radiance(world, cache, *hit.point, -hit.direction, depth, sampler, counts);
  return sample;
}

}  // namespace

void gather_hemisphere(const World& world, const RecordCache* cache, const Place& place, Strata strata,
                       std::uint64_t key, HemisphereGather& gather, RayCounts& counts) {
  gather.position = place.position;
  gather.frame = Frame(place.normal);
  gather.strata = strata;
  gather.samples.resize(static_cast<std::size_t>(strata.size()));
  SurfacePoint surface;
  surface.position = place.position;
  surface.geometric_normal = place.geometric_normal;
  surface.offset = place.offset;
  for (int j = 0, i = 0; j < strata.polar; ++j) {
    for (int k = 0; k < strata.azimuthal; ++k, ++i) {
      Sampler sampler(key, static_cast<std::uint32_t>(i));
      const Vec3 direction = gather.frame.to_world(strata.direction(j, k, sampler.next2()));
      // A direction over the interpolated horizon but under the surface itself sees nothing.
      if (dot(direction, place.geometric_normal) <= 0) {
        gather.samples[i] = {direction, infinity, Rgb{}, -direction, GatherSample::own_surface};
        continue;
      }
      const Ray ray{offset_origin(surface, direction), direction};
      gather.samples[i] = gather_sample(world, cache, ray, place.medium, sampler, counts);
    }
  }
}

}  // namespace isophote
