#pragma once

#include "isophote/core/vec.h"

namespace isophote {

/// The partial derivatives of a value along x, y and z of world space.
template <class V>
struct Gradient {
  V x{}, y{}, z{};

  /// The change of the value along a small displacement or rotation vector.
  V dot(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
  bool operator==(const Gradient&) const = default;
};

/// A value that changes by `amount` per length of `along`, and not across it.
template <class V, class T>
void add(Gradient<V>& g, const Vec3T<T>& along, const V& amount) {
  g.x += amount * along.x, g.y += amount * along.y, g.z += amount * along.z;
}

template <class V>
void add(Gradient<V>& g, const Gradient<V>& more, const V& amount) {
  g.x += more.x * amount, g.y += more.y * amount, g.z += more.z * amount;
}

}  // namespace isophote
