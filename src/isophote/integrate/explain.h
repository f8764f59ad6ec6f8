#pragma once

#include <optional>
#include <vector>

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/render.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {

/// How far a record reaches, in metres, and what made it so.
struct Reach {
  SemiAxes axes;                                ///< as it is used
  float natural = 0;                            ///< the longer of them, had nothing but the metric decided it
  bool gradient = false, neighbours = false;    ///< what made it less before bounds: the gradient, other records
  bool raised = false, lowered = false;         ///< to the least or the largest radius that bounds allow
  float gradient_kept = 1, curvature_kept = 1;  ///< parts left by the limit on extrapolation
};

/// A record that has a share in a value.
struct ServingRecord {
  std::uint32_t id = 0;
  Vec3 position;
  float distance = 0;           ///< m
  float angle = 0;              ///< between the normals, radians
  float footprint_error = 0;    ///< 0 at the record, 1 at its rim
  float weight = 0, share = 0;  ///< before and after division by the sum of all
  Rgb value, extrapolated;      ///< irradiance at the record, and from there at the place, W/m2
  float predicted_error = 0;    ///< relative, of the extrapolated value
  bool tested = false;          ///< it saw something near, and a ray found the way to be free
  Reach reach;
};

/// A record that does not, though it is near.
struct NearMiss {
  std::uint32_t id = 0;
  Standing why = Standing::beyond_rim;
  float distance = 0;  ///< m
  float angle = 0;     ///< between the normals, radians
  float rim = 0;       ///< distance over that of the rim in this direction
};

/// Why a pixel is as it is. What records do is told of the pixel's first sample.
struct Explanation {
  FirstPoint seen;
  float depth = 0;                     ///< of the very first hit along the camera's axis, m
  bool reads_cache = false;            ///< is there a place that a record could serve?
  Vec3 normal;                         ///< that records are asked for
  std::optional<Rgb> irradiance;       ///< by interpolation, W/m2; none where no record serves
  float predicted_error = 0;           ///< relative, of that
  std::vector<ServingRecord> serving;  ///< the greatest share first
  std::vector<NearMiss> near_misses;   ///< a few, the nearest to serving first
  Radiance mean;                       ///< of all samples of the pixel
};
/// job.pilot is to be that of the records: metrics are asked anew what they wanted, of the records as they were `built`
/// before they were fitted to each other; null: they were not.
Explanation explain(const Job& job, const RecordCache& cache, int x, int y, const RecordCache* built = nullptr);

}  // namespace isophote
