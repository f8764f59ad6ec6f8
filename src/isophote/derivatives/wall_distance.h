#pragma once

#include <algorithm>
#include <cstdint>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// How far the wall between two strata is: `minimum` is the nearer of its two samples, as published; `harmonic` is
/// their harmonic mean where both lie on one surface, which is where the surface is at the wall, and the nearer across
/// a step; `refined` is the same, but across a step takes the nearer surface where its tangent plane meets the wall.
enum class WallDistance : std::uint8_t { minimum, harmonic, refined };

/// Inverse distance, in the direction `w`, of the tangent plane of a sample.
inline float inverse_along(const GatherSample& s, const Vec3& w) {
  return dot(s.normal, w) / (dot(s.normal, s.direction) * s.distance);
}

/// Do two neighbours lie on one surface, or on two that meet at the wall between them: are their tangent planes about
/// equally far there? (Whether they belong to one mesh does not matter: depth is continuous where walls meet.)
inline bool one_surface(const GatherSample& p, const GatherSample& q) {
  constexpr float tolerance = 1.3f;
  if (p.distance == infinity || q.distance == infinity) return false;
  const Vec3 wall = normalize(p.direction + q.direction);
  const float a = inverse_along(p, wall), b = inverse_along(q, wall);
  return a > 0 && b > 0 && a < tolerance * b && b < tolerance * a;
}

/// Of the wall between two strata, from what their samples saw.
float inverse_wall_distance(const GatherSample& p, const GatherSample& q, WallDistance distance);

}  // namespace isophote
