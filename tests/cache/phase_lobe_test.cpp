#include <gtest/gtest.h>

#include <cmath>

#include "isophote/cache/volume_cache.h"
#include "support/records.h"

namespace isophote::test {
namespace {

/// [Henyey, Greenstein 1941], of the angle by which light turns.
double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// The sum over all harmonics is the phase function, of light that comes from w and leaves along wo.
TEST(PhaseLobe, IsThePhaseFunction) {
  RandomPlaces random(13);
  std::array<double, harmonics_count(most_volume_bands)> values;
  for (int i = 0; i < 500; ++i) {
    const Vec3 w = random.direction(), wo = random.direction();
    const float g = random.number(-0.35f, 0.35f);
    const PhaseLobe lobe = phase_lobe(g, wo, most_volume_bands);
    evaluate_harmonics(Basis::spherical, most_volume_bands, Vec3d(w), values);
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += double{lobe[k]} * values[k];
    EXPECT_NEAR(sum, henyey_greenstein(g, dot(Vec3d(wo), -Vec3d(w))), 2e-4);
  }
}

// Light from behind, towards the eye, is what forward scattering brings.
TEST(PhaseLobe, ScattersForwards) {
  std::array<double, 4> values;
  const auto seen = [&](const Vec3d& from) {
    const PhaseLobe lobe = phase_lobe(0.5f, {0, 0, 1}, 2);
    evaluate_harmonics(Basis::spherical, 2, from, values);
    return lobe[0] * values[0] + lobe[1] * values[1] + lobe[2] * values[2] + lobe[3] * values[3];
  };
  EXPECT_GT(seen({0, 0, -1}), 3 * std::abs(seen({0, 0, 1})));
}

TEST(PhaseLobe, FewerBandsAreTheFirstOnes) {
  const Vec3 wo{0.6f, 0, 0.8f};
  const PhaseLobe all = phase_lobe(0.6f, wo, 8), few = phase_lobe(0.6f, wo, 3);
  for (std::size_t k = 0; k < few.size(); ++k) EXPECT_EQ(few[k], k < 9 ? all[k] : 0);
  const PhaseLobe even = phase_lobe(0, wo, 8);
  for (std::size_t k = 1; k < even.size(); ++k) EXPECT_EQ(even[k], 0);
  EXPECT_NEAR(even[0], 1 / std::sqrt(4 * M_PI), 1e-7);
}

/// The share of its root mean square that a phase function loses with all bands from `n` on, summed one by one.
double missed(double g, int n) {
  double all = 0, lost = 0;
  for (int l = 0; l < 2000; ++l) {
    const double square = (2 * l + 1) * std::pow(g * g, l);
    all += square;
    if (l >= n) lost += square;
  }
  return std::sqrt(lost / all);
}

TEST(PhaseLobe, HasTheBandsItNeeds) {
  const std::pair<float, int> known[] = {{0, 1}, {0.2f, 3}, {0.3f, 4}, {0.4f, 5}, {0.5f, 6}, {0.6f, 8}, {0.9f, 10}};
  for (const auto& [g, bands] : known) {
    EXPECT_EQ(bands_for(g), bands) << g;
    EXPECT_EQ(bands_for(-g), bands) << g;
  }
  for (float g = 0.01f; g < 1; g += 0.01f) {
    const int bands = bands_for(g);
    EXPECT_TRUE(bands == most_volume_bands || missed(g, bands) <= 0.05) << g;
    EXPECT_TRUE(bands == 1 || missed(g, bands - 1) > 0.05) << g;
    EXPECT_EQ(bands_hold(g), missed(g, most_volume_bands) <= 0.05) << g;
    if (g < 0.66f) {
      EXPECT_LE(missed(g, bands), 0.05) << g;
    }
  }
}

}  // namespace
}  // namespace isophote::test
