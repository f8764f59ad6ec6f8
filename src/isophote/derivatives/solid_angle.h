#pragma once

#include <cmath>

#include "isophote/core/sym3.h"

namespace isophote {

/// The solid angle of the triangle (a, b, c) seen from the origin, positive where they turn left about their middle
/// [van Oosterom, Strackee 1983].
inline double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

/// What an edge from a to b adds to the derivatives of the solid angle to its left as the origin moves. Only sums over
/// closed loops mean anything; their sum of second derivatives is symmetric, so that parts which are not are left out.
struct SolidAngleEdge {
  Vec3d gradient;
  Sym3d hessian;

  // The gradient of a solid angle is the field of a current along its border (Biot and Savart): of a straight piece of
  // it, (a x b) (1/|a| + 1/|b|) / (|a||b| + a . b).
  SolidAngleEdge(const Vec3d& a, const Vec3d& b) {
    const double la = length(a), lb = length(b), d = la * lb + dot(a, b), n = 1 / la + 1 / lb;
    const Vec3d turn = cross(a, b);
    const Vec3d slope =
        (a / (la * la * la) + b / (lb * lb * lb)) / d + (a * (lb / la) + b * (la / lb) + a + b) * (n / (d * d));
    gradient = turn * (n / d);
    hessian = Sym3d::symmetric_outer(turn, slope, 0.5);
  }
};

}  // namespace isophote
