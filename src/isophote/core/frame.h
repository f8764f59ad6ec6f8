#pragma once

#include "isophote/core/vec.h"

namespace isophote {

/// A right-handed orthonormal frame (u, v, n).
template <class T>
struct FrameT {
  Vec3T<T> u{1, 0, 0}, v{0, 1, 0}, n{0, 0, 1};

  FrameT() = default;
  FrameT(const Vec3T<T>& u_, const Vec3T<T>& v_, const Vec3T<T>& n_) : u(u_), v(v_), n(n_) {}
  /// A frame about the unit vector `normal`, continuous but at normal.z = 0 [Duff 2017].
  explicit FrameT(const Vec3T<T>& normal) : n(normal) {
    const T sign = std::copysign(T(1), n.z);
    const T a = T(-1) / (sign + n.z);
    const T b = n.x * n.y * a;
    u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
  }
  template <class S>
  explicit FrameT(const FrameT<S>& f) : u(f.u), v(f.v), n(f.n) {}

  Vec3T<T> to_world(const Vec3T<T>& a) const { return u * a.x + v * a.y + n * a.z; }
  Vec3T<T> to_local(const Vec3T<T>& a) const { return {dot(a, u), dot(a, v), dot(a, n)}; }
};

using Frame = FrameT<float>;
using Framed = FrameT<double>;

}  // namespace isophote
