#include "isophote/integrate/march.h"

#include "isophote/integrate/in_scattering.h"
#include "isophote/trace/placed_lights.h"

namespace isophote {

Marched march(const World& world, const FarLight& from, const Ray& way, int depth, WhereUncovered uncovered,
              Sampler& sampler, RayCounts& counts) {
  constexpr int points = 2;
  Marched out;
  if (depth < world.max_depth) out.direct = placed_lights_along(world, way, {}, sampler, counts);
  for (const Media::RayPoint& at : world.media->sample_points(way, points, sampler)) {
    const Ray before{way.origin, way.direction, way.near, at.distance};
    const Rgb weight = world.media->transmittance(before, sampler.next_bits()) * at.length;
    out.direct += weight * at.emission;
    if (depth >= world.max_depth || is_black(at.scattering)) continue;
    if (const auto indirect = seen_in_scattering(world, from, at.point, way.direction, depth, sampler, counts)) {
      out.direct += weight * at.scattering * direct_light(world, at.point, way.direction, sampler, counts);
      out.indirect += weight * at.scattering * *indirect;
    } else if (uncovered == WhereUncovered::nothing) {
      out = {};
      out.covered = false;
      return out;
    } else {
      const Scattered path = scatter(world, at.point, way.direction, depth, sampler, counts);
      out.direct += weight * at.scattering * path.direct;
      out.indirect += weight * at.scattering * path.indirect;
      out.covered = false;
    }
  }
  out.transmittance = world.media->transmittance(way, sampler.next_bits());
  return out;
}

}  // namespace isophote
