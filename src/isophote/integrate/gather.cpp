#include "isophote/integrate/gather.h"

#include <algorithm>
#include <numeric>

#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

Rgb scattered_radiance(const World& world, const FarLight& from, const FirstPoint& hit, int depth, Sampler& sampler,
                       RayCounts& counts) {
  if (from.none() || hit.medium_point) return path_radiance(world, hit, depth, sampler, counts);
  const Shaded s = shade(world, from, *hit.point, -hit.direction, hit.path_length, depth, sampler, counts);
  return s.direct + s.indirect;
}

GatherSample gather_sample(const World& world, const FarLight& from, const Ray& ray, const Rgb& medium,
                           Sampler& sampler, RayCounts& counts) {
  const FirstPoint hit = first_point(world, ray, false, sampler, counts.gather, medium);
  GatherSample sample{ray.direction, hit.first_distance, hit.emission, hit.first_normal, hit.first_mesh};
  const int depth = 1 + hit.depth;
  if (hit.scatters() && depth < world.max_depth)
    sample.radiance += hit.throughput * scattered_radiance(world, from, hit, depth, sampler, counts);
  return sample;
}

/// A step that visits all of `size` strata, early ones well spread over the hemisphere: the first rays into a cell
/// leave samples that later ones read, and must not all come from one side of it.
int well_spread_step(int size) {
  int step = std::max(1, static_cast<int>(0.618 * size));
  while (std::gcd(step, size) != 1) ++step;
  return step;
}

}  // namespace

void gather_hemisphere(const World& world, const FarLight& from, const Place& place, Strata strata, std::uint64_t key,
                       HemisphereGather& gather, RayCounts& counts) {
  gather.position = place.position;
  gather.frame = Frame(place.normal);
  gather.strata = strata;
  gather.samples.resize(static_cast<std::size_t>(strata.size()));
  SurfacePoint surface;
  surface.position = place.position;
  surface.geometric_normal = place.geometric_normal;
  surface.offset = place.offset;
  const int step = well_spread_step(strata.size());
  for (int n = 0, i = 0; n < strata.size(); ++n, i = (i + step) % strata.size()) {
    Sampler sampler(key, static_cast<std::uint32_t>(i));
    const Vec3 direction =
        gather.frame.to_world(strata.direction(i / strata.azimuthal, i % strata.azimuthal, sampler.next2()));
    // A direction over the interpolated horizon but under the surface itself sees nothing.
    if (dot(direction, place.geometric_normal) <= 0) {
      gather.samples[i] = {direction, infinity, Rgb{}, -direction, GatherSample::own_surface};
      continue;
    }
    const Ray ray{offset_origin(surface, direction), direction};
    gather.samples[i] = gather_sample(world, from, ray, place.medium, sampler, counts);
  }
}

}  // namespace isophote
