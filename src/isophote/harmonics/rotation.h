#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "isophote/core/frame.h"
#include "isophote/harmonics/basis.h"

namespace isophote {

/// Coefficients, of either basis, of a function turned about the pole: g(theta, phi) = f(theta, phi - angle). Exact. In
/// place.
template <class T>
void rotate_about_pole(int order, double angle, std::span<T> coefficients) {
  for (int m = 1; m < order; ++m) {
    const auto c = static_cast<float>(std::cos(m * angle)), s = static_cast<float>(std::sin(m * angle));
    for (int l = m; l < order; ++l) {
      T &even = coefficients[harmonic_index(l, m)], &odd = coefficients[harmonic_index(l, -m)];
      const T turned = even * c - odd * s;
      odd = even * s + odd * c;
      even = turned;
    }
  }
}

/// How spherical harmonics turn: by one orthogonal matrix a band, from the recurrence of [Ivanic, Ruedenberg 1996].
class HarmonicRotation {
 public:
  /// The rotation that takes the axes x, y, z to those of `frame`.
  HarmonicRotation(int order, const Framed& frame);

  /// Coefficients of g(w) = f(R^-1 w), of those of f. `to` and `from` do not overlap.
  template <class T>
  void apply(std::span<const T> from, std::span<T> to) const {
    for (int l = 0; l < order_; ++l)
      for (int m = -l; m <= l; ++m) {
        T sum{};
        for (int n = -l; n <= l; ++n) sum += from[harmonic_index(l, n)] * static_cast<float>(at(l, m, n));
        to[harmonic_index(l, m)] = sum;
      }
  }

  /// How much of function (l, n) turned is (l, m).
  double at(int l, int m, int n) const { return bands_[begin(l) + (m + l) * (2 * l + 1) + n + l]; }

 private:
  static int begin(int l) { return l * (4 * l * l - 1) / 3; }  // the sum of (2 k + 1)^2 over the bands below
  double product(int i, int l, int a, int b) const;
  double element(int l, int m, int n) const;

  int order_;
  std::vector<double> bands_;
};

/// The angle by which azimuths in `from` grow when its axes are carried to those of `to` along the shortest turn of
/// the normal: a direction at azimuth phi of `from` lies there at about phi + angle.
inline float transport_angle(const Frame& from, const Frame& to) {
  // The u axis of `from`, carried by the rotation that takes from.n to to.n, in the frame `to`.
  const Vec3 axis = cross(from.n, to.n);
  const float cosine = dot(from.n, to.n);
  const Vec3 carried = from.u * cosine + cross(axis, from.u) + axis * (dot(axis, from.u) / (1 + cosine));
  return std::atan2(dot(carried, to.v), dot(carried, to.u));
}

}  // namespace isophote
