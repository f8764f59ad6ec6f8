#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "isophote/core/vec.h"

namespace isophote {

/// Gives a tenth of all weights' sum to those above 0 alike, so that none is so weak beside the others, or so often
/// hidden, that it could not be chosen. Returns the sum.
template <class T>
T share_alike(std::span<T> weights) {
  constexpr T part = T(0.1);
  const T sum = std::accumulate(weights.begin(), weights.end(), T(0));
  T positive = 0;
  for (const T w : weights) positive += w > 0;
  for (T& w : weights)
    if (w > 0) w = (1 - part) * w + part * sum / positive;
  return sum;
}

/// Chooses an index with a chance proportional to its weight, in constant time (alias method [Vose 1991]).
class AliasTable {
 public:
  AliasTable() = default;
  /// Weights are not negative and their sum is finite; where all are 0, the table is empty.
  explicit AliasTable(std::span<const double> weights);

  bool empty() const { return entries_.empty(); }
  /// `u` in [0, 1), a multiple of 2^-24. Not on an empty one.
  std::uint32_t sample(float u) const;
  /// With which `sample` gives `index` for u uniform on that grid, exactly: the weight's share, rounded. Not on an
  /// empty one.
  float probability(std::uint32_t index) const { return entries_[index].probability; }

 private:
  struct Entry {
    std::uint32_t threshold = 0;  // of 2^24: below it the slot's own index is taken
    std::uint32_t alias = 0;
    float probability = 0;
  };
  std::vector<Entry> entries_;
};

/// A piecewise constant density on the unit square, width x height cells of given weight, row by row. Within its row
/// and over the rows, a weight's share is rounded to a multiple of 2^-24, the grid of random numbers: less than half of
/// that is never sampled, and its density is 0.
class Distribution2D {
 public:
  Distribution2D() = default;
  /// Weights are finite and not negative; where all are 0, the distribution is empty.
  Distribution2D(std::span<const float> weights, int width, int height);

  bool empty() const { return cumulative_rows_.empty(); }
  /// A point of the unit square, of density `pdf`, for `u` in [0, 1)^2, multiples of 2^-24; consecutive `u` give
  /// consecutive points, so that stratification survives. Not on an empty one.
  Vec2 sample(Vec2 u) const;
  /// Density with respect to area of the unit square. Not on an empty one.
  float pdf(Vec2 p) const;
  /// The chance of a cell: the density times its area. Not on an empty one.
  float probability(int x, int y) const;

 private:
  /// The cumulative values of row y, whose chance is not 0.
  const float* columns(int y) const {
    return cumulative_columns_.data() + static_cast<std::size_t>(stored_row_[y]) * (width_ + 1);
  }

  int width_ = 0, height_ = 0;
  std::vector<float> cumulative_rows_;     // height + 1
  std::vector<std::uint32_t> stored_row_;  // of each row, in cumulative_columns_, which leaves out rows of chance 0
  std::vector<float> cumulative_columns_;  // within each stored row, width + 1
};

}  // namespace isophote
