#pragma once

#include <string>
#include <vector>

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote::bench {

/// A point in a medium that the picture looks at: along the ray through a random place of it, by how much light
/// scattered there would be seen.
struct SeenPoint {
  MediumPoint at;
  Vec3 direction;           ///< of the ray
  std::uint32_t media = 0;  ///< VolumeQuery::media
  float pixel = 0;          ///< length that a pixel spans there
  std::uint64_t key = 0;    ///< seeds what is computed there
};

/// Those at which records are checked, the same for all; and those at which they are made, by the job's seed.
std::vector<SeenPoint> checked_points(const Job& job, std::size_t count);
std::vector<SeenPoint> record_points(const Job& job, std::size_t count);

/// Luminance of what the medium scatters at a point towards the eye, per unit of sigma_s, but for light of directly
/// sampled emitters: by paths, twice, independent of each other and of all that records draw.
struct Truth {
  double first = 0, second = 0;
  double mean() const { return (first + second) / 2; }
};
/// Of so many checked points, each by twice as many paths.
std::vector<Truth> path_truths(const Job& job, std::size_t count, int paths);

void write_truths(const std::string& path, const std::vector<Truth>& truths);
std::vector<Truth> read_truths(const std::string& path);

/// Errors over points, relative to the mean truth.
class InScatteringErrors {
 public:
  void add(double value, const Truth& truth);
  double rmse() const;                               ///< the truths' noise taken out
  double mean() const { return errors_ / truths_; }  ///< of |error|, the truths' noise included
  double bias() const { return bias_ / truths_; }
  double noise() const;  ///< root mean square error of the truths themselves
  int points() const { return points_; }

 private:
  double squares_ = 0, errors_ = 0, bias_ = 0, noise_ = 0, truths_ = 0;
  int points_ = 0;
};
/// Of what records say. Those that they leave uncovered are in no number.
InScatteringErrors errors_at(const Job& job, const std::vector<SeenPoint>& points, const std::vector<Truth>& truths,
                             const RecordCache& cache);

}  // namespace isophote::bench
