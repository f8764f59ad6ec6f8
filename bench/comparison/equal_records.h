#pragma once

#include <string>
#include <vector>

#include "comparison/fixed_points.h"

namespace isophote::bench {

struct Comparison {
  std::vector<std::string> variants;  ///< of methods: variant.h
  std::vector<std::size_t> counts;    ///< of records
  std::string pictures;               ///< a folder for pictures of the records; empty: none
};

/// Solves for each count by each variant, all sharing what places see, and prints a line of JSON with the errors at
/// `points` for each.
void compare_at_equal_records(Job job, const std::vector<FixedPoint>& points, const Comparison& comparison);

}  // namespace isophote::bench
