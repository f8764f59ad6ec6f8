#include "isophote/derivatives/volume_radiance.h"

#include <gtest/gtest.h>

#include "isophote/derivatives/jarosz_2008a.h"
#include "isophote/derivatives/moving_walls.h"
#include "support/known_media.h"

namespace isophote::test {
namespace {

SphereGather gather(Known known, std::optional<std::uint32_t> seed = {}) {
  const KnownPlace& p = known_places[known];
  return gather_sphere(p.room(), p.at, {32, 64}, 24, seed);
}

/// What a phase function makes of coefficients: its own are powers of g, times the harmonics in the direction from
/// which light goes straight on.
double scattered(const Coefficients& coefficients, const PhaseWeight& weight, int order) {
  std::vector<double> harmonics(static_cast<std::size_t>(harmonics_count(order)));
  evaluate_harmonics(Basis::spherical, order, -weight.wo, harmonics);
  double sum = 0;
  for (int l = 0; l < order; ++l)
    for (int m = -l; m <= l; ++m) {
      const auto i = static_cast<std::size_t>(harmonic_index(l, m));
      sum += std::pow(weight.phase.g, l) * harmonics[i] * static_cast<double>(coefficients[i].r);
    }
  return sum;
}

void expect_scattered(const VolumeJet& jet, const WeighedRadiance& expected, const PhaseWeight& weight, int order) {
  EXPECT_NEAR(scattered(jet.value, weight, order), expected.value.r, 2e-4 * expected.value.r);
  const Vec3d gradient{scattered(jet.translational.x, weight, order), scattered(jet.translational.y, weight, order),
                       scattered(jet.translational.z, weight, order)};
  const Vec3d known{expected.gradient.x.r, expected.gradient.y.r, expected.gradient.z.r};
  EXPECT_LT(relative_error(gradient, known), 2e-3);
}

TEST(VolumeRadiance, CoefficientsStandForAnyPhaseFunction) {
  constexpr int order = 10;
  const SphereGather g = gather(P2_fog_lobe, 1);
  const PhaseWeight weight{{0.4}};
  for (const VolumePart part : both_parts) {
    expect_scattered(jarosz_2008a(g, part, order), weigh_fixed_places(g, part, weight)[0], weight, order);
    expect_scattered(moving_walls(g, part, order), weigh_moving_walls(g, part, weight)[0], weight, order);
    EXPECT_EQ(volume_radiance(g, part, order).value, moving_walls(g, part, order).value);
    EXPECT_TRUE(volume_radiance(g, part, order).translational.x.empty());
  }
}

TEST(VolumeRadiance, SumsMagnitudes) {
  const SphereGather g = gather(P1);
  for (const VolumePart part : both_parts) {
    const VolumeJet jet = jarosz_2008a(g, part, 1), walls = moving_walls(g, part, 2),
                    bare = volume_radiance(g, part, 1);
    const double mean_factor = 1 / std::sqrt(4 * std::numbers::pi);
    const Vec3d gradient =
        Vec3d{jet.translational.x[0].r, jet.translational.y[0].r, jet.translational.z[0].r} * mean_factor;
    EXPECT_NEAR(jet.value_sum, jet.value[0].r * mean_factor, 1e-6);
    // Gradients of samples cancel, but for what is nearest to each.
    EXPECT_GT(jet.gradient_sum, length(gradient));
    EXPECT_LT(jet.gradient_sum, 30 * length(gradient));
    for (const VolumeJet& other : {walls, bare}) {
      EXPECT_EQ(other.value_sum, jet.value_sum);
      EXPECT_EQ(other.gradient_sum, jet.gradient_sum);
      EXPECT_EQ(other.standard_error, jet.standard_error);
    }
    EXPECT_EQ(jet.rays, 32u * 64);
    EXPECT_TRUE(jet.obstacles.before({-0.55f, 0, 0}));  // the wall is 0.6 away
    EXPECT_FALSE(jet.obstacles.before({0.55f, 0, 0}));
  }
}

// The two lights of equal strength beside the record, whose gradients cancel: the sum of magnitudes does not.
TEST(VolumeRadiance, MagnitudesDoNotCancel) {
  const SphereStrata strata{8, 16};
  SphereGather g{{}, strata, 0, {}, {}, {}, std::vector<Rgb>(128)};
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 16; ++k) {
      const Vec3 w = strata.direction(j, k, {0.5f, 0.5f});
      g.samples.push_back({w, 2, Rgb(1), -w, 1});
      g.layers.push_back({Rgb(1), 2, {}});
    }
  const VolumeJet jet = jarosz_2008a(g, VolumePart::surfaces, 1), walls = moving_walls(g, VolumePart::surfaces, 4);
  EXPECT_NEAR(jet.translational.x[0].r, 0, 1e-6);
  EXPECT_NEAR(jet.gradient_sum, 1, 1e-6);  // 3 w / r - w / r of each
  EXPECT_NEAR(jet.value_sum, 1, 1e-6);
  EXPECT_EQ(jet.standard_error, 0);
  EXPECT_EQ(jet.obstacles.distance(7), 2);
  for (const auto* along : {&walls.translational.x, &walls.translational.y, &walls.translational.z})
    for (const Rgb& c : *along) EXPECT_EQ(c, Rgb());
}

TEST(VolumeRadiance, KnowsItsStandardError) {
  for (const VolumePart part : both_parts) {
    double sum = 0, squares = 0, claimed = 0;
    constexpr int seeds = 24;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const VolumeJet jet = volume_radiance(gather(P1, seed), part, 1);
      const double mean = static_cast<double>(jet.value_sum);
      sum += mean, squares += mean * mean, claimed += static_cast<double>(jet.standard_error) / seeds;
    }
    const double is = std::sqrt((squares - sum * sum / seeds) / (seeds - 1));
    std::printf("  standard error %.2g, claimed %.2g\n", is, claimed);
    EXPECT_LT(is, 1.5 * claimed);
    EXPECT_GT(is, 0.2 * claimed);
  }
}

TEST(VolumeRadiance, OfTheSkyChangesByNothing) {
  const SphereStrata strata{4, 8};
  SphereGather g{{}, strata, 0, {}, {}, {}, std::vector<Rgb>(32)};
  for (int i = 0; i < 32; ++i) {
    const Vec3 w = strata.direction(i / 8, i % 8, {0.5f, 0.5f});
    g.samples.push_back({w, infinity, Rgb(static_cast<float>(i)), -w, 0});
    g.layers.push_back({Rgb(static_cast<float>(i)), infinity, {}});
  }
  for (const VolumeJet& jet : {jarosz_2008a(g, VolumePart::surfaces, 3), moving_walls(g, VolumePart::surfaces, 3)})
    for (const auto* along : {&jet.translational.x, &jet.translational.y, &jet.translational.z})
      for (const Rgb& c : *along) EXPECT_EQ(c, Rgb());
}

}  // namespace
}  // namespace isophote::test
