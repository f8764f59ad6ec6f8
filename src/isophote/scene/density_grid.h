#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "isophote/core/affine.h"
#include "isophote/core/vec.h"

namespace isophote {

/// Density at the points of a regular grid, interpolated trilinearly, 0 beyond it. Coordinates of the grid are those in
/// which its points lie at whole numbers; an affine map takes them to world space.
class DensityGrid {
 public:
  struct Impl;
  explicit DensityGrid(std::unique_ptr<const Impl> impl);
  ~DensityGrid();

  /// A grid of `size` points (i, j, k) from (0, 0, 0) on; `values` are finite, >= 0 and stand with i fastest, then j.
  /// `to_world`, not singular, takes coordinates of the grid to metres. Throws UserError for other values.
  static std::shared_ptr<const DensityGrid> from_values(const std::array<int, 3>& size, std::vector<float> values,
                                                        const Affine& to_world);

  /// To and from coordinates of the grid: points, and directions (which lose their unit length).
  Vec3d to_grid(const Vec3d& p) const;
  Vec3d direction_to_grid(const Vec3d& d) const;
  /// Where it may be above 0, in the grid's coordinates (a voxel's reach included) and in world space.
  Box grid_bounds() const;
  Box world_bounds() const;

  float density(const Vec3& p) const;           ///< world space
  Vec3 gradient(const Vec3& p) const;           ///< of the interpolant, 1/m, world space
  float density_in_grid(const Vec3d& q) const;  ///< at coordinates of the grid

  /// The grid's coordinates are cut into cubes of `block` from (block i, block j, block k); the largest density that
  /// interpolation gives in one of them.
  static constexpr int block = 8;
  float block_majorant(int i, int j, int k) const;
  float majorant() const;

  /// A number that differs where the grid does.
  std::uint64_t content_hash() const;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace isophote
