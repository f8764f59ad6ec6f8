#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// The cache with every record fitted to its neighbours (cache/regression.h), for reading: to go on building, keep the
/// one it came from.
RecordCache regressed(const Job& job, const RecordCache& cache, RayCounts& counts);

}  // namespace isophote
