#pragma once

#include <cmath>

#include "isophote/derivatives/edge.h"
#include "isophote/derivatives/tangent.h"

namespace isophote {

/// Derivatives of the irradiance from polygons, by Lambert's sum over their edges, in the local frame of the point that
/// moves: it is the origin, its normal z. Edges go counter-clockwise seen from above; only closed loops mean anything.
struct LambertSum {
  TangentGradient gradient;
  TangentHessian hessian;

  /// An edge with one radiance on its left and another on its right.
  void add(const Vec3d& a, const Vec3d& b, const Rgbd& left, const Rgbd& right) {
    if (left == right) return;
    Edge e;
    const double angle = std::atan2(length(cross(a, b)), dot(a, b));
    if (!e.set(a, b, angle)) return;
    const EdgeMoments s(e);
    const Vec3d turn{-e.t.y, e.t.x, 0};  // n x t
    const Vec3d p = e.m * s.s20 + e.t * s.s11;
    const Rgbd step = left - right;
    gradient.u += step * ((angle * turn.x + 2 * e.c.z * p.x) / (2 * e.h));
    gradient.v += step * ((angle * turn.y + 2 * e.c.z * p.y) / (2 * e.h));
    const auto entry = [&](int i, int j) {
      const double squares =
          s.s40 * e.m[i] * e.m[j] + s.s31 * (e.m[i] * e.t[j] + e.t[i] * e.m[j]) + s.s22 * e.t[i] * e.t[j];
      return turn[i] * p[j] + p[i] * turn[j] + e.c.z * (4 * squares - (i == j ? s.s20 : 0));
    };
    const double second = luminance(step) / (e.h * e.h);
    hessian.uu += second * entry(0, 0), hessian.uv += second * entry(0, 1), hessian.vv += second * entry(1, 1);
  }
};

}  // namespace isophote
