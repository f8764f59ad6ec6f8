#pragma once

#include <cstddef>

#include "isophote/integrate/build.h"

namespace isophote {

/// Builds caches with different thresholds until one has about `wanted` records (within 2%, or the nearest of ten
/// tries; fewer where no threshold gives as many or as few), and leaves the threshold in job.method. Tries cost full
/// builds.
struct Solved {
  RecordCache cache;
  BuildReport report;  ///< of all tries together; rounds of the one kept
};
Solved build_with_records(Job& job, std::size_t wanted);

}  // namespace isophote
