#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// The measured error of a cache: |E - E_ref| / (E_ref + 0.01 mean E), luminance, over random visible points.
struct MeasuredError {
  int points = 0;  ///< 0: nothing could be measured, the rest means nothing
  double mean = 0, median = 0, p95 = 0;
  double bias = 0;  ///< (mean E - mean E_ref) / mean E_ref
  double largest = 0;
  int largest_x = 0, largest_y = 0;  ///< the pixel in which the point of the largest error is seen
  double noise = 0;  ///< mean error of E_ref itself, in the same measure: what `mean` would be for a perfect cache
  RayCounts rays;
  bool cancelled = false;  ///< the host wanted no more: nothing was measured

  /// Is it surely above what was asked? The measured mean contains the measurement's noise.
  bool exceeds(double asked) const { return points > 0 && mean - noise > asked; }
};

/// Compares the cache with path-traced gathers at random visible points, as many as `ray_budget` rays pay for, but no
/// fewer than 40 and no more than 1024. Each `turn` has points of its own: a cache that was refined where it was
/// measured is measured elsewhere. `built` are its records before they were fitted, whose own noise says how many rays
/// a gather takes; null: they were not.
MeasuredError check_points(const Job& job, const RecordCache& cache, std::uint64_t ray_budget, int turn = 0,
                           const RecordCache* built = nullptr);

}  // namespace isophote
