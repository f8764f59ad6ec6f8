#pragma once

#include <cstddef>

#include "isophote/integrate/build.h"

namespace isophote {

/// Builds caches with different thresholds until one has about `wanted` records (within `records_tolerance`, or the
/// nearest of ten tries; fewer where no threshold gives as many or as few), and leaves the threshold in job.method.
/// Tries cost full builds where gathers read the cache; else a place that several tries ask for is gathered once.
struct Solved {
  RecordCache cache;
  BuildReport report;  ///< rays of all tries together; the rest of the one kept
};
inline constexpr double records_tolerance = 0.02;
Solved build_with_records(Job& job, std::size_t wanted);

}  // namespace isophote
