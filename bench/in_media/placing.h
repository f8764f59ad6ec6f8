#pragma once

#include <array>
#include <optional>
#include <vector>

#include "in_media/seen_point.h"
#include "isophote/cache/volume_cache.h"

namespace isophote::bench {

/// Places for records in media, in order, and what each sees, by all estimators, gathered where it is first
/// asked: methods and thresholds differ in where records lie, not in what a place sees. Gathers follow paths; a jet is
/// the mean of those of `gathers` of them, for rays of one share the depths at which they look for light.
class Places {
 public:
  Places(const Job& job, std::vector<SeenPoint> points, int gathers);

  std::size_t size() const { return points_.size(); }
  const SeenPoint& point(std::size_t i) const { return points_[i]; }
  int bands(std::size_t i) const { return bands_for(job_.world.media->anisotropy(points_[i].media)); }
  const VolumeJet& jet(std::size_t i, const VolumeEstimator& estimator, VolumePart part);
  /// Gathers at the first places, in parallel.
  void prepare(std::size_t count);

 private:
  using Jets = std::vector<std::array<VolumeJet, 2>>;  // by estimator of the catalogue and part
  Jets look(std::size_t i, RayCounts& counts) const;

  const Job& job_;
  int gathers_;
  std::vector<SeenPoint> points_;
  std::vector<std::optional<Jets>> jets_;
};

/// By what a few places see, of both parts together: with it `volume_error` allows the same integral everywhere.
Pilot survey_media(Places& places);

/// Records by the job's method at each place that none serves when its turn comes. Nothing where they would be more
/// than `most`.
std::optional<RecordCache> place_records(const Job& job, Places& places, std::size_t most);

inline std::size_t count_records(const VolumeCaches& caches) {
  return caches.surfaces.records().size() + caches.media.records().size();
}

}  // namespace isophote::bench
