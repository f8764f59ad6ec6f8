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

}  // namespace isophote
