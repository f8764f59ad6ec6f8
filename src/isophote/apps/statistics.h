#pragma once

#include <optional>
#include <string>

#include "isophote/cache/radiance_cache.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/integrate/check_points.h"
#include "isophote/integrate/job.h"
#include "isophote/integrate/pilot.h"

namespace isophote::app {

/// What a render took and measured, for people and for scripts.
struct Statistics {
  std::string method, estimator, metric, bounds;
  Secondary secondary = Secondary::off;  ///< as asked
  Seeding seeding;
  bool lazy = false, adaptive = false, leak_test = false, regress = false, cancelled = false, checked = false;
  std::optional<double> error_asked;
  std::optional<int> records_asked;
  float a = 0, aspect = 1;
  Pilot survey{};
  int extrapolate = 0;
  double record_rays = 0;  ///< in the mean
  Strata strata;
  /// Records of incident radiance.
  struct GlossyRecords {
    GlossyMethod method{};
    std::size_t records = 0, bytes = 0;
    double bands = 0, rays = 0;  ///< in the mean

    void take(const GlossyMethod& method, const RadianceCache& cache);
  };
  std::optional<GlossyRecords> glossy;
  /// Records of radiance in media.
  struct MediaRecords {
    VolumeMethod method{};
    std::size_t surfaces = 0, media = 0, bytes = 0;  ///< of their light, records; of both, memory

    void take(const VolumeMethod& method, const VolumeCaches& caches);
  };
  std::optional<MediaRecords> media;
  std::size_t records = 0, rounds = 0, triangles = 0;
  int passes = 0, refinements = 0;
  std::uint64_t uncovered = 0, samples = 0, seed = 0;
  int threads = 0, width = 0, height = 0;
  RayCounts rays;
  struct Phases {
    Clock load, build, check, final, total;
  } time;
  MeasuredError error;

  /// Fills in what the operating system knows: the most memory held so far, in bytes.
  static std::uint64_t peak_memory();
  void print() const;
  void write_json(const std::string& path) const;
};

}  // namespace isophote::app
