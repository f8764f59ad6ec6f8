#include "isophote/integrate/pilot.h"

#include "isophote/integrate/build.h"
#include "isophote/integrate/gather.h"
#include "isophote/validity/total_error.h"

namespace isophote {

Pilot run_pilot(const Job& job, RayCounts& counts) {
  constexpr std::size_t points = 256;
  constexpr int rays = 200;
  if (!job.method.caches() || (job.method.metric->needs < 2 && !job.method.adaptive)) return {};
  const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::pilot), job.seed);
  std::vector<std::optional<Record>> seen(points);
  counts += for_each(job.parallel, points, 1, [&](std::size_t i, RayCounts& each) {
    Sampler stream(key, static_cast<std::uint32_t>(i));
    const Vec2 at = stream.next2();
    const Ray ray = job.camera.ray(at.x * job.width, at.y * job.height, job.width, job.height);
    const std::optional<Place> place = place_of(job, first_point(job.world, ray, true, stream, each.camera));
    if (!place) return;
    HemisphereGather gather;
    gather_hemisphere(job.world, nullptr, *place, Strata::about(rays), hash(key, i), gather, each);
    Record& record = seen[i].emplace();
    record.normal = place->normal;
    record.jet = job.method.estimator->estimate(gather);
  });
  double irradiance = 0, rate = 0, count = 0;
  for (const auto& record : seen)
    if (record) irradiance += luminance(record->jet.value), ++count;
  if (count == 0) return {};
  Pilot pilot;
  pilot.irradiance = static_cast<float>(irradiance / count);
  for (const auto& record : seen)
    if (record) rate += error_rate(record->jet, record->normal, pilot.irradiance);
  pilot.error_rate = static_cast<float>(rate / count);
  return pilot;
}

}  // namespace isophote
