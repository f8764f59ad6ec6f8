#include "isophote/harmonics/strata_harmonics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/harmonics/quadrature.h"

namespace isophote {
namespace {

constexpr int order = 12, count = harmonics_count(order);

Vec3d direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The sum over theta's parts times phi's: what `add` makes of one row.
std::vector<double> product(const StrataHarmonics& h, std::span<const double> polar, std::span<const double> azimuth) {
  std::vector<double> all(count);
  h.add<double>(polar, azimuth, all);
  return all;
}

class StrataHarmonicsOf : public testing::TestWithParam<Basis> {};

// Everything against the functions themselves, by quadrature over one cell and its walls.
TEST_P(StrataHarmonicsOf, CellsAndWalls) {
  const Strata strata{5, 9};
  const StrataHarmonics h(GetParam(), order, strata);
  const auto& rule = GaussRule<40>::get();
  std::vector<double> values(count);
  for (const int j : {0, 2, 4})
    for (const int k : {0, 3, 8}) {
      const double inner = strata.theta_edge(j), outer = strata.theta_edge(j + 1), from = strata.azimuth(k),
                   to = strata.azimuth(k + 1);
      std::vector<double> cell(count), sines(count), wall(count), ring_u(count), ring_v(count);
      // Where functions have a root at the horizon, in a variable that smoothes it: theta = outer - t^2.
      rule.integrate(0, std::sqrt(outer - inner), [&](double t, double weight_t) {
        const double theta = outer - t * t, weight = 2 * t * weight_t;
        rule.integrate(from, to, [&](double phi, double w) {
          evaluate_harmonics(GetParam(), order, direction(theta, phi), values);
          for (int i = 0; i < count; ++i) {
            cell[i] += values[i] * std::sin(theta) * weight * w;
            sines[i] += values[i] * std::pow(std::sin(theta), 2) * weight * w;
          }
        });
        evaluate_harmonics(GetParam(), order, direction(theta, from), values);
        for (int i = 0; i < count; ++i) wall[i] += values[i] * weight;
      });
      rule.integrate(from, to, [&](double phi, double w) {
        evaluate_harmonics(GetParam(), order, direction(inner, phi), values);
        for (int i = 0; i < count; ++i) {
          ring_u[i] += values[i] * std::cos(phi) * w;
          ring_v[i] += values[i] * std::sin(phi) * w;
        }
      });
      const auto of_cell = product(h, h.over_ring(j), h.over_cell(k));
      const auto of_sines = product(h, h.sin_over_ring(j), h.over_cell(k));
      const auto of_wall = product(h, h.along_ring(j), h.between_cells(k));
      const auto of_u = product(h, h.between_rings(j), h.cos_over_cell(k));
      const auto of_v = product(h, h.between_rings(j), h.sin_over_cell(k));
      for (int i = 0; i < count; ++i) {
        EXPECT_NEAR(of_cell[i], cell[i], 1e-9) << i;
        EXPECT_NEAR(of_sines[i], sines[i], 1e-9) << i;
        EXPECT_NEAR(of_wall[i], wall[i], 1e-9) << i;
        EXPECT_NEAR(of_u[i], ring_u[i], 1e-9) << i;
        EXPECT_NEAR(of_v[i], ring_v[i], 1e-9) << i;
      }
    }
}

TEST(StrataHarmonics, OneRingHoldsTheHemisphere) {
  const StrataHarmonics h(Basis::hemispherical, most_order, {1, 3});
  for (int l = 0; l < most_order; ++l)
    EXPECT_NEAR(h.over_ring(0)[polar_index(l, 0)], l == 0 ? 1 / std::sqrt(2 * std::numbers::pi) : 0, 1e-11) << l;
}

INSTANTIATE_TEST_SUITE_P(EitherBasis, StrataHarmonicsOf, testing::Values(Basis::spherical, Basis::hemispherical));

}  // namespace
}  // namespace isophote
