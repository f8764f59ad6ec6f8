#pragma once

#include <string>
#include <vector>

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote::bench {

/// A visible place and its irradiance (luminance), twice: independent of each other, and of all random numbers that
/// builds use.
struct FixedPoint {
  Vec3 position, normal;
  double first = 0, second = 0;
};

/// As many points, seen through random places of the picture, each with two path-traced gathers of `rays` rays.
std::vector<FixedPoint> make_points(const Job& job, std::size_t count, int rays);

void write_points(const std::string& path, const std::vector<FixedPoint>& points);
std::vector<FixedPoint> read_points(const std::string& path);

/// Errors of luminance over the points, relative to its mean over them.
struct PointErrors {
  double rmse = 0;                        ///< the references' noise taken out
  double bias = 0;                        ///< mean of cache - reference
  double mean = 0;                        ///< of |cache - reference|, noise included
  double noise = 0;                       ///< root mean square error of the references themselves
  std::size_t points = 0, uncovered = 0;  ///< uncovered ones are in no other number
};
PointErrors point_errors(const World& world, const std::vector<FixedPoint>& points, const RecordCache& cache);

}  // namespace isophote::bench
