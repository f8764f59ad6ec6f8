#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "isophote/core/affine.h"
#include "isophote/scene/density_grid.h"

namespace isophote {

/// Where a grid's values are kept. Safe to read from any number of threads.
class Voxels {
 public:
  virtual ~Voxels() = default;
  /// The values at the corners (i + a, j + b, k + c) of a cell, at out[4 a + 2 b + c], a, b, c being 0 or 1; 0 where
  /// there is none. The cell has at least one corner within the grid's `lower` and `upper`.
  virtual void corners(int i, int j, int k, float out[8]) const = 0;
};

/// Points lower <= (i, j, k) <= upper of a grid.
struct IndexBox {
  std::array<int, 3> lower{1, 1, 1}, upper{0, 0, 0};

  bool empty() const { return lower[0] > upper[0] || lower[1] > upper[1] || lower[2] > upper[2]; }
};

/// For each cube of `DensityGrid::block` that values of points reach, the largest of these.
class BlockMajorants {
 public:
  /// Of points within `points`, which must not be empty.
  explicit BlockMajorants(const IndexBox& points);
  static std::uint64_t bytes(const IndexBox& points);

  /// Takes in that the points of a box have `value`.
  void raise(const IndexBox& points, float value);
  float at(int i, int j, int k) const;
  float largest() const { return largest_; }

 private:
  std::size_t index(int i, int j, int k) const;
  IndexBox blocks_;
  std::vector<float> values_;
  float largest_ = 0;
};

struct DensityGrid::Impl {
  std::unique_ptr<const Voxels> voxels;
  IndexBox points;  ///< outside, all is 0
  BlockMajorants majorants;
  Affine to_world, to_grid;
  std::uint64_t hash = 0;  ///< of the values and of `to_world`
};

/// Takes an affine map into a hash.
std::uint64_t hash_of(std::uint64_t seed, const Affine& map);

}  // namespace isophote
