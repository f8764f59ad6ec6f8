#pragma once

#include <vector>

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// What a cache is like at the first sample of each pixel, row by row; 0 where no record serves.
struct RecordMaps {
  std::vector<float> error;    ///< relative error of the irradiance that the records' use predicts
  std::vector<float> density;  ///< records per square metre
};
RecordMaps record_maps(const Job& job, const RecordCache& cache, RayCounts& rays);

/// The error that interpolation at a place predicts: the mean of its records', weighted as their values are.
float predicted_error_at(const RecordCache& cache, const Query& query, OpenTest open, const ErrorModel& model);

/// Records per square metre at a place. Each record is spread over the ellipse of its footprint, as a cone of volume
/// 1, so that the integral over a surface is the number of its records.
float record_density(const RecordCache& cache, const Query& query, OpenTest open);

}  // namespace isophote
