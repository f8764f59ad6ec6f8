#include "isophote/integrate/adaptive_rays.h"

#include <algorithm>

#include "isophote/derivatives/standard_error.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {

Strata strata_for(const Job& job, const RecordCache* cache, const Place& place, float noise, int most,
                  HemisphereGather& scratch, RayCounts& counts) {
  constexpr int ahead = 200;  // no fewer are worth a record: derivatives need them
  const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::pilot), place.key);
  gather_hemisphere(job.world, cache, place, Strata::about(ahead), key, scratch, counts);
  const Jet<Rgb> jet = irradiance(scratch);
  const float value = 0.99f * luminance(jet.value) + 0.01f * job.pilot.irradiance;
  const float times = value > 0 ? jet.standard_error / (noise * value) : 0;
  return Strata::about(static_cast<int>(std::clamp(ahead * times * times, float{ahead}, static_cast<float>(most))));
}

}  // namespace isophote
