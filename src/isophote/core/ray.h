#pragma once

#include <limits>

#include "isophote/core/vec.h"

namespace isophote {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float pi = 3.14159265358979323846f;

/// The points origin + t direction with near < t < far. `direction` is a unit vector, so t is a distance.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float near = 0;
  float far = infinity;
};

}  // namespace isophote
