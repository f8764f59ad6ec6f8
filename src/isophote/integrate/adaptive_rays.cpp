#include "isophote/integrate/adaptive_rays.h"

#include <algorithm>
#include <cmath>

namespace isophote {

Strata strata_for(float spread, const Pilot& pilot, float noise) {
  const float rays = std::pow(pilot.noise_rate / noise, 2.0f) * std::cbrt(spread * spread);
  return Strata::about(rays > fewest_rays ? static_cast<int>(std::min(rays, float{most_rays})) : fewest_rays);
}

float relative_spread(const Jet<Rgb>& jet, const Pilot& pilot) {
  const float value = 0.99f * luminance(jet.value) + 0.01f * pilot.irradiance;
  return value > 0 ? jet.standard_error * std::sqrt(static_cast<float>(jet.rays)) / value : 0;
}

Strata strata_near(const Job& job, const RecordCache& cache, const Place& place) {
  float nearest = infinity, spread = std::pow(job.pilot.noise_rate, 1.5f);
  cache.visit_near(place.position, [&](const Record& record) {
    if (dot(record.normal, place.normal) <= 0) return;
    const float distance = length_squared(place.position - record.position);
    if (distance > 0 && distance < nearest) nearest = distance, spread = relative_spread(record.jet, job.pilot);
  });
  return strata_for(spread, job.pilot, job.method.noise());
}

}  // namespace isophote
