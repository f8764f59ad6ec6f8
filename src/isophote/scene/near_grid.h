#pragma once

#include <cstdint>
#include <vector>

#include "isophote/core/vec.h"

namespace isophote {

/// Marks the cells of a coarse grid that come near to given places: a test in constant time that errs to true.
class NearGrid {
 public:
  struct Place {
    Box box;
    float distance = 0;  ///< all points within it of the box (in the largest coordinate) are near
  };

  NearGrid() = default;
  /// Points to be asked about lie in `bounds`. Takes constant time for each place, however large.
  NearGrid(const Box& bounds, const std::vector<Place>& places);

  bool marked(const Vec3& p) const;

 private:
  static constexpr int side = 64;
  int cell(float x, int axis) const;
  static std::size_t index(int x, int y, int z) { return (static_cast<std::size_t>(z) * side + y) * side + x; }

  Vec3 lower_, cell_size_;
  std::vector<std::uint8_t> marks_;  // one a cell; empty: none
};

}  // namespace isophote
