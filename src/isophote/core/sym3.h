#pragma once

#include "isophote/core/vec.h"

namespace isophote {

/// A symmetric 3x3 matrix.
template <class T>
struct Sym3T {
  T xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// `s` times the identity.
  static constexpr Sym3T scaled_identity(T s) { return {s, 0, 0, s, 0, s}; }
  /// s v v^T
  static constexpr Sym3T outer(const Vec3T<T>& v, T s) {
    return {s * v.x * v.x, s * v.x * v.y, s * v.x * v.z, s * v.y * v.y, s * v.y * v.z, s * v.z * v.z};
  }
  /// The identity but for the direction of the unit vector w.
  static constexpr Sym3T across(const Vec3T<T>& w) {
    return {1 - w.x * w.x, -w.x * w.y, -w.x * w.z, 1 - w.y * w.y, -w.y * w.z, 1 - w.z * w.z};
  }
  /// s (u v^T + v u^T)
  static constexpr Sym3T symmetric_outer(const Vec3T<T>& u, const Vec3T<T>& v, T s) {
    return {2 * s * u.x * v.x, s * (u.x * v.y + u.y * v.x), s * (u.x * v.z + u.z * v.x),
            2 * s * u.y * v.y, s * (u.y * v.z + u.z * v.y), 2 * s * u.z * v.z};
  }

  Sym3T() = default;
  constexpr Sym3T(T xx_, T xy_, T xz_, T yy_, T yz_, T zz_) : xx(xx_), xy(xy_), xz(xz_), yy(yy_), yz(yz_), zz(zz_) {}
  template <class S>
  explicit constexpr Sym3T(const Sym3T<S>& a)
      : Sym3T(static_cast<T>(a.xx), static_cast<T>(a.xy), static_cast<T>(a.xz), static_cast<T>(a.yy),
              static_cast<T>(a.yz), static_cast<T>(a.zz)) {}

  constexpr Sym3T operator+(const Sym3T& o) const {
    return {xx + o.xx, xy + o.xy, xz + o.xz, yy + o.yy, yz + o.yz, zz + o.zz};
  }
  constexpr Sym3T& operator+=(const Sym3T& o) { return *this = *this + o; }
  constexpr Sym3T operator*(T s) const { return {xx * s, xy * s, xz * s, yy * s, yz * s, zz * s}; }
  constexpr bool operator==(const Sym3T&) const = default;
};

using Sym3 = Sym3T<float>;
using Sym3d = Sym3T<double>;

/// A v
template <class T>
constexpr Vec3T<T> operator*(const Sym3T<T>& a, const Vec3T<T>& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// v . (A v)
template <class T>
constexpr T quadratic_form(const Sym3T<T>& a, const Vec3T<T>& v) {
  return a.xx * v.x * v.x + a.yy * v.y * v.y + a.zz * v.z * v.z +
         2 * (a.xy * v.x * v.y + a.xz * v.x * v.z + a.yz * v.y * v.z);
}

/// Of a matrix that has one.
template <class T>
constexpr Sym3T<T> inverse(const Sym3T<T>& a) {
  const Sym3T<T> cofactors{a.yy * a.zz - a.yz * a.yz, a.xz * a.yz - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy,
                           a.xx * a.zz - a.xz * a.xz, a.xy * a.xz - a.xx * a.yz, a.xx * a.yy - a.xy * a.xy};
  return cofactors * (1 / (a.xx * cofactors.xx + a.xy * cofactors.xy + a.xz * cofactors.xz));
}

/// The root of the sum of squares of all nine entries: no eigenvalue is larger.
template <class T>
T norm(const Sym3T<T>& a) {
  return std::sqrt(a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz));
}

}  // namespace isophote
