#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isophote/core/vec.h"

namespace isophote {

/// Chooses an index with a chance proportional to its weight, in constant time (alias method [Vose 1991]).
class AliasTable {
 public:
  AliasTable() = default;
  /// Weights are not negative; where all are 0, the table is empty.
  explicit AliasTable(std::span<const double> weights);

  bool empty() const { return entries_.empty(); }
  /// `u` in [0, 1), a multiple of 2^-24.
  std::uint32_t sample(float u) const;
  /// With which `sample` gives `index` for u uniform on that grid, exactly: the weight's share, rounded.
  float probability(std::uint32_t index) const { return entries_[index].probability; }

 private:
  struct Entry {
    std::uint32_t threshold = 0;  // of 2^24: below it the slot's own index is taken
    std::uint32_t alias = 0;
    float probability = 0;
  };
  std::vector<Entry> entries_;
};

/// A piecewise constant density on the unit square, width x height cells of given weight, row by row.
class Distribution2D {
 public:
  Distribution2D() = default;
  /// Weights are not negative; where all are 0, the distribution is empty.
  Distribution2D(std::span<const float> weights, int width, int height);

  bool empty() const { return rows_.empty(); }
  /// A point of the unit square; consecutive `u` give consecutive points, so that stratification survives.
  Vec2 sample(Vec2 u) const;
  /// Density with respect to area of the unit square.
  float pdf(Vec2 p) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> rows_;     // cumulative over rows, height + 1
  std::vector<float> columns_;  // cumulative within each row, (width + 1) per row
};

}  // namespace isophote
