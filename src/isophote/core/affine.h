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
  /// The gradient of f(point(p)) where that of f is `g`: the transpose of the linear part applied to it.
  Vec3d pull_back(const Vec3d& g) const { return {dot(x, g), dot(y, g), dot(z, g)}; }
  /// The determinant must not be 0.
  Affine inverse() const {
    const double d = determinant();
    const Vec3d a = cross(y, z) / d, b = cross(z, x) / d, c = cross(x, y) / d;
    Affine inverse{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, {}};
    inverse.origin = -inverse.vector(origin);
    return inverse;
  }

  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
  }
};

}  // namespace isophote
