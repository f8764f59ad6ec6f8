#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isophote/core/vec.h"

namespace isophote {

/// The upper hemisphere cut into `polar` rings of equal projected solid angle, each cut into `azimuthal` cells: cell
/// (j, k) holds sin^2 theta in [j, j+1]/M and phi in 2 pi [k, k+1]/N. One cosine-distributed direction per cell is a
/// stratified estimate of an integral against the cosine. Samples are stored ring by ring: index j * N + k.
struct Strata {
  int polar = 0;      ///< M
  int azimuthal = 0;  ///< N

  /// About `rays` cells with N close to pi M, which makes cells about as long as they are wide.
  static Strata about(int rays) {
    const int m = std::max(1, static_cast<int>(std::lround(std::sqrt(rays / std::numbers::pi))));
    return {m, std::max(3, static_cast<int>(std::lround(static_cast<double>(rays) / m)))};
  }

  int size() const { return polar * azimuthal; }
  bool operator==(const Strata&) const = default;

  /// sin and cos of the polar angle between rings j - 1 and j, for j in [0, M]. j/M is formed before it is subtracted,
  /// so that a fused multiply-add cannot make the horizon's cosine the root of a negative number.
  double sin_edge(int j) const { return std::sqrt(ratio(j)); }
  double cos_edge(int j) const { return std::sqrt(std::max(0.0, 1.0 - ratio(j))); }
  double theta_edge(int j) const { return std::atan2(sin_edge(j), cos_edge(j)); }
  /// The azimuth between cells k - 1 and k; the middle of cell k is at k + 1/2.
  double azimuth(double k) const { return 2 * std::numbers::pi * k / azimuthal; }

  /// The direction of cell (j, k) at `u` in the unit square, in the local frame (z along the normal).
  Vec3 direction(int j, int k, Vec2 u) const {
    const double sin2 = (j + static_cast<double>(u.x)) / polar;
    const double s = std::sqrt(sin2), phi = azimuth(k + static_cast<double>(u.y));
    return Vec3(Vec3d(s * std::cos(phi), s * std::sin(phi), std::sqrt(std::max(0.0, 1.0 - sin2))));
  }

 private:
  double ratio(int j) const { return static_cast<double>(j) / polar; }
};

}  // namespace isophote
