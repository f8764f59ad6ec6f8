#pragma once

#include "isophote/cache/radiance_cache.h"
#include "isophote/cache/record_neighbours.h"

namespace isophote {

/// Fits each record of incident radiance to what its neighbours say of it: by least squares a plane through the values
/// and gradients of each coefficient, in which a neighbour counts by its rays and less the farther it is. One small
/// system serves all coefficients, for their weights are the same.
class RadianceRegression {
 public:
  /// Of all records as they are, which must stay so while this is used.
  explicit RadianceRegression(const RadianceCache& cache);

  /// The record with its value and gradient after the fit. Neighbours that `open` finds hidden, those of fewer
  /// bands or without gradients, and those that face another way are left out. Any thread may ask.
  RadianceRecord fitted(std::uint32_t id, OpenTest open) const;

 private:
  RecordNeighbours<RadianceRecord> neighbours_;
};

}  // namespace isophote
