#pragma once

#include <array>

#include "isophote/core/sym3.h"

namespace isophote {

/// The eigenvalues of a symmetric matrix, and for each its axis; the axes are orthonormal. In no particular order.
struct Eigen3 {
  std::array<double, 3> values;
  std::array<Vec3d, 3> axes;

  explicit Eigen3(const Sym3d& matrix);
};

}  // namespace isophote
