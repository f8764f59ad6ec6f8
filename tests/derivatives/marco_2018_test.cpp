#include "isophote/derivatives/marco_2018.h"

#include <gtest/gtest.h>

#include "isophote/derivatives/moving_walls.h"
#include "isophote/derivatives/solid_angle.h"
#include "support/known_media.h"

namespace isophote::test {
namespace {

TEST(SolidAngle, IsDifferentiatedAsDifferencesSay) {
  const Vec3d a{1, 0.2, -0.3}, b{0.4, 1.1, 0.2}, c{-0.1, 0.3, 0.9};
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 2, 0}, {0, 0, 3}), std::numbers::pi / 2, 1e-14);
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 0, 3}, {0, 2, 0}), -std::numbers::pi / 2, 1e-14);
  const auto derivatives = [&](const Vec3d& x) {
    Vec3d gradient;
    Sym3d hessian;
    for (const SolidAngleEdge& e :
         {SolidAngleEdge(a - x, b - x), SolidAngleEdge(b - x, c - x), SolidAngleEdge(c - x, a - x)})
      gradient += e.gradient, hessian += e.hessian;
    return std::pair(gradient, hessian);
  };
  const auto [gradient, hessian] = derivatives({});
  for (int i = 0; i < 3; ++i) {
    constexpr double h = 1e-4;
    Vec3d step;
    step[i] = h;
    const double first =
        (solid_angle(a - step, b - step, c - step) - solid_angle(a + step, b + step, c + step)) / (2 * h);
    EXPECT_NEAR(first, gradient[i], 1e-7);
    const Vec3d second = (derivatives(step).first - derivatives(-step).first) / (2 * h);
    EXPECT_LT(length(second - hessian * (step / h)), 1e-6);
  }
  EXPECT_NEAR(hessian.xx + hessian.yy + hessian.zz, 0, 1e-13);
}

struct Grid {
  SphereStrata strata;
  int shells;
};
constexpr Grid grids[] = {{{16, 32}, 16}, {{32, 64}, 24}, {{64, 128}, 32}};

struct Errors {
  double gradient = 0, hessian = 0;
};
/// Root mean square over seeds; without seeds, of the samples in the middle.
Errors errors(const KnownPlace& p, VolumePart part, const Grid& grid, std::uint32_t seeds = 0, bool looked_at = false) {
  const KnownRadiance& known = p.known(part);
  const Lobe lobe{p.g, turned_axes().to_local(outgoing())};
  const std::uint32_t count = std::max(1u, seeds);
  Errors squares;
  for (std::uint32_t i = 1; i <= count; ++i) {
    const auto seed = seeds ? std::optional(i) : std::nullopt;
    MediaShells shells(grid.shells, looked_at ? seed : std::nullopt);
    if (looked_at) shells.shares[0] = 0.5;
    const WeighedCurvature is = weigh_triangles(gather_sphere(p.room(), p.at, grid.strata, shells, seed), part, lobe);
    squares.gradient += std::pow(relative_error(in_room(is.gradient), known.gradient), 2) / count;
    squares.hessian += std::pow(relative_error(in_room(is.hessian), known.hessian), 2) / count;
  }
  return {std::sqrt(squares.gradient), std::sqrt(squares.hessian)};
}

/// The errors of an independent program, which knew the second derivatives of transmittance and sources, by grid.
struct Row {
  Known known;
  double surfaces[3], media[3];
};

TEST(Marco2018, HasTheHessiansOfHomogeneousMedia) {
  const Row rows[] = {{P1, {0.13, 0.044, 0.021}, {0.018, 0.017, 0.012}},
                      {P1_lobe, {0.40, 0.054, 0.012}, {0.024, 0.023, 0.015}},
                      {P4, {0.31, 0.21, 0.14}, {0.22, 0.18, 0.14}},
                      {P4_lobe, {0.19, 0.12, 0.12}, {0.29, 0.28, 0.25}}};
  for (const Row& row : rows)
    for (int i = 0; i < 3; ++i) {
      const KnownPlace& p = known_places[row.known];
      const double s = errors(p, VolumePart::surfaces, grids[i]).hessian,
                   m = errors(p, VolumePart::media, grids[i]).hessian;
      std::printf("  Hessian, %-22s %2dx%dx%d: surfaces / media %5.1f / %4.1f%%\n", p.name, grids[i].strata.polar,
                  grids[i].strata.azimuthal, grids[i].shells, 100 * s, 100 * m);
      EXPECT_LT(s, 1.1 * row.surfaces[i]) << p.name;
      // The sources' second derivatives are differences between samples.
      EXPECT_LT(m, (p.g == 0 ? 1.1 : i == 0 ? 2.9 : 1.6) * row.media[i]) << p.name;
    }
}

// Where media differ along a ray, a gather does not say by how much: metrics take a root of the error.
TEST(Marco2018, HasRoughlyTheHessiansOfOthers) {
  const struct {
    Known known;
    double surfaces, media;
  } rows[] = {{P1_fog, 0.30, 0.02}, {P1_blob_lobe, 0.80, 0.08}, {P2_fog_lobe, 0.13, 0.07}};
  for (const auto& row : rows) {
    const KnownPlace& p = known_places[row.known];
    const double s = errors(p, VolumePart::surfaces, grids[1]).hessian,
                 m = errors(p, VolumePart::media, grids[1]).hessian;
    std::printf("  Hessian, %-22s: surfaces / media %5.1f / %4.1f%%\n", p.name, 100 * s, 100 * m);
    EXPECT_LT(s, row.surfaces) << p.name;
    EXPECT_LT(m, row.media) << p.name;
  }
}

TEST(Marco2018, HasGradientsAwareOfOcclusion) {
  const struct {
    Known known;
    Errors coarse, fine;  ///< of surfaces and of media, at 32x64x24 and 128x256x48
  } rows[] = {{P1, {0.013, 0.012}, {0.0038, 0.0034}},
              {P1_lobe, {0.013, 0.017}, {0.0002, 0.0034}},
              {P1_fog, {0.012, 0.013}, {0.0031, 0.0034}},
              {P1_blob_lobe, {0.011, 0.015}, {0.0003, 0.0033}},
              {P4, {0.078, 0.061}, {0.015, 0.015}}};
  for (const auto& row : rows) {
    const KnownPlace& p = known_places[row.known];
    for (const bool fine : {false, true}) {
      const Grid grid = fine ? Grid{{128, 256}, 48} : grids[1];
      const double s = errors(p, VolumePart::surfaces, grid).gradient, m = errors(p, VolumePart::media, grid).gradient;
      std::printf("  gradient, %-22s %3dx%dx%d: surfaces / media %5.2f / %5.2f%%\n", p.name, grid.strata.polar,
                  grid.strata.azimuthal, grid.shells, 100 * s, 100 * m);
      const auto& known = fine ? row.fine : row.coarse;
      EXPECT_LT(s, 1.3 * known.gradient + 0.0005) << p.name;
      EXPECT_LT(m, 1.3 * known.hessian) << p.name;
    }
  }
}

TEST(Marco2018, IsAsGoodWithJitteredSamples) {
  const auto expect_below = [](const char* what, const Errors& is, double gradient, double hessian) {
    std::printf("  %-44s gradient / Hessian %.1f / %.1f%%\n", what, 100 * is.gradient, 100 * is.hessian);
    EXPECT_LT(is.gradient, gradient) << what;
    EXPECT_LT(is.hessian, hessian) << what;
  };
  using enum VolumePart;
  expect_below("P4, surfaces", errors(known_places[P4], surfaces, grids[1], 8), 0.09, 0.28);
  expect_below("P4, media", errors(known_places[P4], media, grids[1], 8), 0.065, 0.20);
  expect_below("P1, surfaces", errors(known_places[P1], surfaces, grids[1], 8), 0.02, 0.08);
  expect_below("P1, media", errors(known_places[P1], media, grids[1], 8), 0.015, 0.025);
  // Also where each shell is looked at in one place only.
  expect_below("P1, media, one place a shell", errors(known_places[P1], media, grids[1], 8, true), 0.12, 0.2);
  expect_below("P2, fog, g 0.6, media, one place a shell", errors(known_places[P2_fog_lobe], media, grids[1], 8, true),
               0.08, 0.4);
}

TEST(Marco2018, GivesTheMeanItsDerivativesAndOtherBandsThoseOfWalls) {
  const KnownPlace& p = known_places[P2];
  const SphereGather gather = gather_sphere(p.room(), p.at, {16, 32}, 16, 3);
  for (const VolumePart part : both_parts) {
    const VolumeJet jet = marco_2018(gather, part, 3), walls = moving_walls(gather, part, 3);
    const WeighedCurvature mean = weigh_triangles(gather, part);
    EXPECT_EQ(jet.value, walls.value);
    EXPECT_EQ(jet.gradient_sum, walls.gradient_sum);
    for (std::size_t i = 1; i < 9; ++i) {
      EXPECT_EQ(jet.translational.x[i], walls.translational.x[i]);
      EXPECT_EQ(jet.translational.z[i], walls.translational.z[i]);
    }
    const double factor = std::sqrt(4 * std::numbers::pi);
    EXPECT_FLOAT_EQ(jet.translational.y[0].g, static_cast<float>(mean.gradient.y.g * factor));
    EXPECT_EQ(jet.hessian, Sym3(mean.hessian));
  }
}

/// What all rays see is this, at any depth.
SphereGather surrounded_by(const Rgb& radiance, float depth) {
  const SphereStrata strata{6, 12};
  SphereGather g{{}, strata, 0, {}, {}, {}, std::vector<Rgb>(static_cast<std::size_t>(strata.size()))};
  for (int i = 0; i < strata.size(); ++i) {
    const Vec3 w = strata.direction(i / 12, i % 12, {0.3f, 0.6f});
    const float distance = depth + 0.1f * static_cast<float>(i % 7);
    g.samples.push_back({w, distance, radiance, -w, 1});
    g.layers.push_back({radiance, distance, {}});
  }
  return g;
}

TEST(Marco2018, HasNoDerivativesInAFurnaceNorOfTheSky) {
  for (const float depth : {2.0f, infinity}) {
    const VolumeJet jet = marco_2018(surrounded_by({1, 2, 3}, depth), VolumePart::surfaces, 1);
    EXPECT_EQ(jet.hessian, Sym3());
    EXPECT_EQ(jet.translational.x[0], Rgb());
    EXPECT_EQ(jet.translational.y[0], Rgb());
    EXPECT_EQ(jet.translational.z[0], Rgb());
  }
}

TEST(Marco2018, ChannelsDoNotMix) {
  SphereGather gather = surrounded_by({1, 2, 3}, 1);
  for (std::size_t i = 0; i < gather.layers.size(); ++i)
    gather.layers[i].radiance = Rgb(static_cast<float>(i % 5), 1, 0);
  const WeighedCurvature is = weigh_triangles(gather, VolumePart::surfaces);
  EXPECT_NE(is.gradient.x.r, 0);
  EXPECT_EQ(is.gradient.x.g, 0);
  EXPECT_EQ(is.gradient.x.b, 0);
}

}  // namespace
}  // namespace isophote::test
