#pragma once

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// The strata with which a gather at `place` reaches the standard error `noise`, relative to its luminance, judged by a
/// few rays sent ahead. These are not used again: an estimate that ends where it looks good is biased. `most` is a
/// limit on the number of rays.
Strata strata_for(const Job& job, const RecordCache* cache, const Place& place, float noise, int most,
                  HemisphereGather& scratch, RayCounts& counts);

/// No record has more rays than these.
inline constexpr int most_rays = 1 << 14;

}  // namespace isophote
