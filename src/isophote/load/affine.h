#pragma once

#include "isophote/core/vec.h"

namespace isophote {

/// p -> x p.x + y p.y + z p.z + origin
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(const Vec3d& p) const { return vector(p) + origin; }
  double determinant() const { return dot(x, cross(y, z)); }
  /// Along the inverse transpose of the linear part applied to `n`, of any length; defined for singular ones too.
  Vec3d normal(const Vec3d& n) const {
    const Vec3d cofactor = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -cofactor : cofactor;
  }

  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
  }
};

}  // namespace isophote
