#include "isophote/integrate/meet.h"

#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

Rgb scattered_radiance(const World& world, const FarLight& from, const FirstPoint& hit, int depth, Sampler& sampler,
                       RayCounts& counts) {
  if (from.none() || hit.medium_point) return path_radiance(world, hit, depth, sampler, counts);
  const Shaded s = shade(world, from, *hit.point, -hit.direction, hit.path_length, depth, sampler, counts);
  return s.direct + s.indirect;
}

}  // namespace

GatherSample meet(const World& world, const FarLight& from, const Ray& ray, const Rgb& inside, int depth,
                  Sampler& sampler, RayCounts& counts) {
  const FirstPoint hit = first_point(world, ray, false, sampler, counts.gather, inside, FirstSegment::clear, depth);
  GatherSample sample{ray.direction, hit.first_distance, hit.emission, hit.first_normal, hit.first_mesh};
  depth += hit.depth;
  if (hit.scatters() && depth < world.max_depth)
    sample.radiance += hit.throughput * scattered_radiance(world, from, hit, depth, sampler, counts);
  return sample;
}

}  // namespace isophote
