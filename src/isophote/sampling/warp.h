#pragma once

#include <cmath>

#include "isophote/core/frame.h"
#include "isophote/core/ray.h"
#include "isophote/core/vec.h"

namespace isophote {

// Maps of the unit square, each beside its density. Directions are in the local frame, z along the normal.

/// A direction of the upper hemisphere with density cos(theta)/pi in solid angle.
inline Vec3 cosine_hemisphere(Vec2 u) {
  const float r = std::sqrt(u.x), phi = 2 * pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x))};
}
inline float cosine_hemisphere_pdf(float cos_theta) { return std::max(0.0f, cos_theta) / pi; }

/// A direction of the sphere with density 1/(4 pi) in solid angle.
inline Vec3 uniform_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline float uniform_sphere_pdf() { return 1 / (4 * pi); }

/// Barycentric coordinates (of the second and third vertex) uniform over the area of a triangle; density 1/area.
inline Vec2 uniform_triangle(Vec2 u) {
  const float s = std::sqrt(u.x);
  return {s * (1 - u.y), s * u.y};
}

}  // namespace isophote
