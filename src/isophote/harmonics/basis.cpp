#include "isophote/harmonics/basis.h"

#include <array>
#include <cmath>
#include <numbers>

#include "isophote/core/check.h"

namespace isophote {
namespace {

using std::numbers::sqrt2;

/// Factors of the recurrence over l, which know nothing of z.
struct Recurrence {
  std::array<double, polar_count(most_order + 1)> forward{}, sector{};

  Recurrence() {
    for (int l = 1; l <= most_order; ++l) {
      sector[l] = std::sqrt((2 * l + 1.0) / (2.0 * l));
      for (int m = 0; m < l; ++m)
        forward[polar_index(l, m)] = std::sqrt((4.0 * l * l - 1) / (static_cast<double>(l) * l - m * m));
    }
  }
};

const Recurrence& recurrence() {
  static const Recurrence factors;
  return factors;
}

/// Re and Im of (x + i y)^m: r^m cos(m phi) and r^m sin(m phi).
struct Powers {
  std::array<double, most_order> re, im;

  Powers(int order, double x, double y) {
    re[0] = 1, im[0] = 0;
    for (int m = 1; m < order; ++m) re[m] = re[m - 1] * x - im[m - 1] * y, im[m] = re[m - 1] * y + im[m - 1] * x;
  }
};

void evaluate_spherical(int order, const Vec3d& w, double scale, std::span<double> values) {
  std::array<double, polar_count(most_order)> polar;
  evaluate_legendre(order, w.z, polar);
  const Powers powers(order, w.x, w.y);
  for (int l = 0; l < order; ++l) {
    values[harmonic_index(l, 0)] = scale * polar[polar_index(l, 0)];
    for (int m = 1; m <= l; ++m) {
      const double q = sqrt2 * scale * polar[polar_index(l, m)];
      values[harmonic_index(l, m)] = q * powers.re[m];
      values[harmonic_index(l, -m)] = q * powers.im[m];
    }
  }
}

/// The derivatives along x, y and z of the polynomials that `evaluate_spherical` evaluates.
void differentiate_spherical(int order, const Vec3d& w, double scale, std::span<Vec3d> slopes) {
  std::array<double, polar_count(most_order + 1)> polar;
  evaluate_legendre(order, w.z, polar);
  const Powers powers(order, w.x, w.y);
  for (int l = 0; l < order; ++l)
    for (int m = 0; m <= l; ++m) {
      const double q = (m > 0 ? sqrt2 : 1) * scale * polar[polar_index(l, m)];
      const double dz =
          m < l ? (m > 0 ? sqrt2 : 1) * scale * std::sqrt((l - m) * (l + m + 1.0)) * polar[polar_index(l, m + 1)] : 0;
      const double re = m > 0 ? m * powers.re[m - 1] : 0, im = m > 0 ? m * powers.im[m - 1] : 0;
      slopes[harmonic_index(l, m)] = {q * re, -q * im, dz * powers.re[m]};
      if (m > 0) slopes[harmonic_index(l, -m)] = {q * im, q * re, dz * powers.im[m]};
    }
}

/// The map under which hemispherical harmonics are spherical ones, times sqrt(2): it stretches the cosine from [0, 1]
/// to [-1, 1] and keeps the azimuth, so that areas double.
struct Stretch {
  Vec3d w;
  double across, slope;  ///< the factor of x and y, and its derivative along z

  explicit Stretch(const Vec3d& from) {
    const double z = std::max(from.z, 1e-12);
    across = std::sqrt(4 * z / (1 + z));
    slope = 2 / (across * (1 + z) * (1 + z));
    w = {across * from.x, across * from.y, 2 * z - 1};
  }
};

}  // namespace

void evaluate_legendre(int order, double z, std::span<double> values) {
  const Recurrence& r = recurrence();
  double diagonal = std::sqrt(0.25 / std::numbers::pi);
  for (int m = 0; m < order; ++m) {
    if (m > 0) diagonal *= r.sector[m];
    double before = 0, here = diagonal, back = 0;
    values[polar_index(m, m)] = here;
    for (int l = m + 1; l < order; ++l) {
      const double forward = r.forward[polar_index(l, m)], next = forward * (z * here - back * before);
      before = here, here = next, back = 1 / forward;
      values[polar_index(l, m)] = here;
    }
  }
}

void evaluate_harmonics(Basis basis, int order, const Vec3d& w, std::span<double> values) {
  ISOPHOTE_CHECK(order, <=, most_order);
  if (basis == Basis::spherical) return evaluate_spherical(order, w, 1, values);
  evaluate_spherical(order, Stretch(w).w, sqrt2, values);
}

void evaluate_harmonics(Basis basis, int order, const Vec3d& w, std::span<double> values, std::span<Vec3d> slopes) {
  evaluate_harmonics(basis, order, w, values);
  const auto count = static_cast<std::size_t>(harmonics_count(order));
  if (basis == Basis::spherical) {
    differentiate_spherical(order, w, 1, slopes);
  } else {
    const Stretch s(w);
    differentiate_spherical(order, s.w, sqrt2, slopes);
    for (Vec3d& g : slopes.first(count))
      g = {s.across * g.x, s.across * g.y, 2 * g.z + s.slope * (w.x * g.x + w.y * g.y)};
  }
  for (Vec3d& g : slopes.first(count)) g -= w * dot(g, w);
}

}  // namespace isophote
