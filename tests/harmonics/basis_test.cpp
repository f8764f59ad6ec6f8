#include "isophote/harmonics/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "isophote/core/frame.h"
#include "isophote/harmonics/quadrature.h"

namespace isophote {
namespace {

constexpr Basis both[] = {Basis::spherical, Basis::hemispherical};
constexpr double half_turn = std::numbers::pi;

/// A function as it is defined, by the standard library's Legendre functions.
double defined(Basis basis, int l, int m, double z, double phi) {
  const int k = std::abs(m);
  const bool half = basis == Basis::hemispherical;
  const double norm =
      std::sqrt((2 * l + 1) * std::tgamma(l - k + 1) / ((half ? 2 : 4) * half_turn * std::tgamma(l + k + 1)));
  const double part = norm * std::assoc_legendre(l, k, half ? 2 * z - 1 : z);
  return m == 0 ? part : std::numbers::sqrt2 * part * (m > 0 ? std::cos(m * phi) : std::sin(k * phi));
}

Vec3d direction(double z, double phi) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(Harmonics, AreWhatTheyAreDefinedToBe) {
  std::vector<double> values(harmonics_count(most_order));
  for (const Basis basis : both)
    for (const double z : {1.0, 0.9999, 0.7, 0.31, 0.001, -0.4})
      for (const double phi : {0.0, 0.4, 2.0, 5.5}) {
        if (basis == Basis::hemispherical && z < 0) continue;
        evaluate_harmonics(basis, most_order, direction(z, phi), values);
        for (int l = 0; l < most_order; ++l)
          for (int m = -l; m <= l; ++m)
            EXPECT_NEAR(values[harmonic_index(l, m)], defined(basis, l, m, z, phi), 1e-10) << l << " " << m << " " << z;
      }
}

TEST(Harmonics, AreOrthonormal) {
  constexpr int order = most_order, count = harmonics_count(order), azimuths = 64;
  const auto& rule = GaussRule<40>::get();
  for (const Basis basis : both) {
    std::vector<double> gram(count * count), values(count);
    rule.integrate(basis == Basis::spherical ? -1 : 0, 1, [&](double z, double weight) {
      for (int k = 0; k < azimuths; ++k) {
        evaluate_harmonics(basis, order, direction(z, 2 * half_turn * k / azimuths), values);
        for (int i = 0; i < count; ++i)
          for (int j = 0; j <= i; ++j) gram[i * count + j] += values[i] * values[j] * weight * 2 * half_turn / azimuths;
      }
    });
    for (int i = 0; i < count; ++i)
      for (int j = 0; j <= i; ++j) ASSERT_NEAR(gram[i * count + j], i == j, 1e-11) << i << " " << j;
  }
}

TEST(Harmonics, SlopesAreDifferences) {
  constexpr int count = harmonics_count(most_order);
  std::vector<double> values(count), ahead(count), behind(count);
  std::vector<Vec3d> slopes(count);
  for (const Basis basis : both)
    for (const double z : {1.0, 0.97, 0.5, 0.1})
      for (const double phi : {0.3, 4.0}) {
        const Vec3d w = direction(z, phi);
        evaluate_harmonics(basis, most_order, w, values, slopes);
        const Framed frame(w);
        for (const Vec3d& t : {frame.u, frame.v}) {
          constexpr double h = 1e-5;
          const Vec3d forward = w * std::cos(h) + t * std::sin(h), back = w * std::cos(h) - t * std::sin(h);
          evaluate_harmonics(basis, most_order, forward, ahead);
          evaluate_harmonics(basis, most_order, back, behind);
          for (int i = 0; i < count; ++i) {
            EXPECT_NEAR(dot(slopes[i], t), (ahead[i] - behind[i]) / (2 * h), 2e-5) << i << " at " << z;
            EXPECT_NEAR(dot(slopes[i], w), 0, 1e-9);
          }
        }
      }
}

}  // namespace
}  // namespace isophote
