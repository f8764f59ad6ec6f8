#pragma once

#include <cmath>

#include "isophote/core/vec.h"

namespace isophote {

/// A straight segment a..b as seen from the origin: its point at angle al is h (m + t tan al), for al from that of a to
/// that of b.
struct Edge {
  Vec3d m, t, c;  ///< orthonormal; c = m x t is normal to the plane through origin and segment
  double h = 0;   ///< distance of the segment's line, above 0
  double sin_a = 0, cos_a = 1, sin_b = 0, cos_b = 1;
  double angle = 0;  ///< that the segment subtends

  /// False where the segment is a point or points at the origin. `angle` is that between a and b.
  bool set(const Vec3d& a, const Vec3d& b, double subtended) {
    const Vec3d between = b - a;
    const double size = length(between);
    if (!(size > 0)) return false;
    t = between / size;
    const double at = dot(a, t), bt = dot(b, t);
    const Vec3d nearest = a - t * at;
    h = length(nearest);
    if (!(h > 1e-12 * (std::abs(at) + std::abs(bt)))) return false;
    m = nearest / h;
    c = cross(m, t);
    const double to_a = length(a), to_b = length(b);
    sin_a = at / to_a, cos_a = h / to_a;
    sin_b = bt / to_b, cos_b = h / to_b;
    angle = subtended;
    return true;
  }
};

/// Integrals of cos^i al sin^k al over an edge.
struct EdgeMoments {
  double s20, s11, s40, s31, s22;

  explicit EdgeMoments(const Edge& e) {
    const double a2 = e.sin_a * e.sin_a, b2 = e.sin_b * e.sin_b, ac2 = e.cos_a * e.cos_a, bc2 = e.cos_b * e.cos_b;
    const double twofold = (e.sin_b * e.cos_b - e.sin_a * e.cos_a) / 2;
    const double fourfold = (e.sin_b * e.cos_b * (bc2 - b2) - e.sin_a * e.cos_a * (ac2 - a2)) / 8;
    s20 = e.angle / 2 + twofold;
    s11 = (b2 - a2) / 2;
    s40 = 3 * e.angle / 8 + twofold + fourfold;
    s31 = (ac2 * ac2 - bc2 * bc2) / 4;
    s22 = e.angle / 8 - fourfold;
  }
};

}  // namespace isophote
