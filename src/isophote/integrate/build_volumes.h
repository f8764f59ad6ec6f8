#pragma once

#include <array>
#include <span>
#include <vector>

#include "isophote/cache/volume_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// Fills the part of a cache that knows the media, where the job's method caches them: in rounds, like surfaces, of
/// points along the ways of camera rays to the first surface, chosen by what is seen from there.
class VolumeBuilder {
 public:
  VolumeBuilder(const Job& job, RecordCache& cache) : job_(job), cache_(cache) {}

  /// Covers the points that sample `sample` of every stride-th pixel shows. Returns how many were uncovered.
  std::size_t cover(int stride, int sample, RayCounts& rays);
  /// Makes lookup fast again after radii have shrunk.
  void finish();
  /// Did the host stop it?
  bool cancelled() const { return cancelled_; }
  /// Rounds so far.
  std::size_t rounds() const { return rounds_; }

 private:
  /// An uncovered point.
  struct Candidate {
    Vec3 position;
    std::uint32_t media = 0;
    float pixel = 0;        ///< length that a pixel spans there
    std::uint64_t key = 0;  ///< seeds what is computed here; its turn too: well spread
    int bands = 1;
    bool wants[2] = {};                   ///< by VolumePart
    float nearest = infinity, reach = 0;  ///< of the record nearest in terms of its own footprint: distance and radius
  };

  /// What a gather at a candidate says of the parts that it wants, by VolumePart.
  using Jets = std::array<std::optional<VolumeJet>, 2>;

  std::vector<Candidate> uncovered(int stride, int sample, RayCounts& rays) const;
  bool still_wants(Candidate& candidate, RayCounts& counts) const;
  void meet_records(Candidate& candidate) const;
  /// Keeps those that no record serves yet.
  void leave_wanting(std::vector<Candidate>& candidates, RayCounts& rays) const;
  /// Learns from the first candidates what the wanted error makes of a threshold, where the metric asks and nothing is
  /// known yet; their gathers become the first records. True: it did.
  bool survey(std::span<Candidate> candidates, RayCounts& rays);
  std::vector<Jets> jets_at(std::span<const Candidate> places, RayCounts& rays) const;
  /// Makes records of jets at places.
  void add(std::span<const Candidate> places, std::span<Jets> jets);

  const Job& job_;
  RecordCache& cache_;
  std::size_t rounds_ = 0;
  bool cancelled_ = false;
  Pilot pilot_{};
};

}  // namespace isophote
