#include "isophote/derivatives/jarosz_2008b.h"

#include <gtest/gtest.h>

#include "isophote/derivatives/ward_heckbert_1992.h"
#include "support/media_room.h"

namespace isophote::test {
namespace {

using Kind = AnalyticMedium::Kind;

/// The sun's light made 20 times as strong, so that it matters beside the walls'.
MediaRoom sunny() {
  MediaRoom room(Kind::homogeneous, 0);
  room.sun *= 20;
  return room;
}
// On the floor at (-0.1, -0.3), of an independent program by differences of fine quadratures.
constexpr double from_surfaces = 0.8879726, from_media = 20 * 0.0161614;
const Vec3d by_surfaces{0.06251, -0.03603, 0}, by_media = Vec3d{-0.008836, 0.034236, 0} * 20.0;

HemisphereGather gather(const MediaRoom& room, Strata strata, int shells, std::optional<std::uint32_t> seed = {}) {
  return gather_floor(room, -0.1, -0.3, strata, shells, seed);
}
Vec3d red(const Gradient<Rgb>& g) { return {g.x.r, g.y.r, g.z.r}; }

using Estimate = Jet<Rgb> (*)(const HemisphereGather&);
constexpr Estimate unaware = [](const HemisphereGather&g) { return ward_heckbert_1992(g, RotationWeights::exact); },
                   minimum = [](const HemisphereGather&g) { return jarosz_2008b(g, WallDistance::minimum); },
                   refined = [](const HemisphereGather&g) { return jarosz_2008b(g); };

/// Relative error of the whole gradient.
double error(Estimate estimate, Strata strata, int shells, int seeds = 0) {
  double sum = 0;
  const Vec3d truth = by_surfaces + by_media;
  for (int seed = 1; seed <= std::max(1, seeds); ++seed) {
    const auto g = seeds ? gather(sunny(), strata, shells, seed) : gather(sunny(), strata, shells);
    sum += length_squared(red(estimate(g).translational) - truth) / length_squared(truth);
  }
  return std::sqrt(sum / std::max(1, seeds));
}

TEST(Jarosz2008b, GivesTheIrradianceOfSurfacesAndMedia) {
  EXPECT_NEAR(jarosz_2008b(gather(sunny(), {64, 192}, 24)).value.r, from_surfaces + from_media, 2e-3);
}

TEST(Jarosz2008b, ConvergesWithMediaAndOccluders) {
  const struct {
    Strata strata;
    int shells;
    double unaware, minimum, refined;
  } rows[] = {{{8, 24}, 12, 0.48, 0.106, 0.019},
              {{16, 48}, 16, 0.49, 0.052, 0.0039},
              {{32, 96}, 24, 0.49, 0.028, 0.0037},
              {{64, 192}, 32, 0.49, 0.015, 0.0028}};
  for (const auto& row : rows) {
    const double u = error(unaware, row.strata, row.shells), m = error(minimum, row.strata, row.shells),
                 r = error(refined, row.strata, row.shells);
    std::printf("  jarosz2008b, %dx%dx%d: unaware of media %.1f%%, minimum %.2f%%, refined %.2f%%\n", row.strata.polar,
                row.strata.azimuthal, row.shells, 100 * u, 100 * m, 100 * r);
    EXPECT_NEAR(u, row.unaware, 0.02);
    EXPECT_LT(m, 1.1 * row.minimum);
    EXPECT_LT(r, 1.6 * row.refined);
  }
}

TEST(Jarosz2008b, DoesSoWithJitteredSamples) {
  constexpr int seeds = 8;
  const double u = error(unaware, {32, 96}, 24, seeds), m = error(minimum, {32, 96}, 24, seeds),
               r = error(refined, {32, 96}, 24, seeds);
  std::printf("  jarosz2008b, jittered: unaware of media %.1f%%, minimum %.2f%%, refined %.2f%%\n", 100 * u, 100 * m,
              100 * r);
  EXPECT_NEAR(u, 0.49, 0.02);
  EXPECT_LT(m, 1.3 * 0.034);
  EXPECT_LT(r, 1.3 * 0.0096);
}

// Where media scatter forward, what begins at the record is not alike on all sides.
TEST(Jarosz2008b, KnowsTheSourcesAtTheRecord) {
  MediaRoom room(Kind::fog, 0.6);
  const Vec3d at{-0.85, 0.45, 0};
  const auto media_only = [&](double x, double y, Strata strata, int shells) {
    HemisphereGather g = gather_floor(room, x, y, strata, shells);
    for (std::size_t i = 0; i < g.samples.size(); ++i) {
      GatherLayer& surface = g.layers[i * static_cast<std::size_t>(shells + 1)];
      g.samples[i].radiance = g.samples[i].radiance - surface.radiance;
      surface.radiance = {};
    }
    return g;
  };
  ASSERT_GT(room.source(at, {0, 0, 1}), 0);
  HemisphereGather g = media_only(at.x, at.y, {64, 192}, 32);
  const auto value = [&](double x, double y) {
    return static_cast<double>(irradiance(media_only(x, y, {128, 384}, 2)).value.r);
  };
  constexpr double h = 0.04;
  const Vec3d truth{(value(at.x + h, at.y) - value(at.x - h, at.y)) / (2 * h),
                    (value(at.x, at.y + h) - value(at.x, at.y - h)) / (2 * h), 0};
  const Vec3d with = red(jarosz_2008b(g).translational);
  g.sources.clear();
  const Vec3d without = red(jarosz_2008b(g).translational);
  const double right = length(with - truth) / length(truth), wrong = length(without - truth) / length(truth);
  std::printf("  jarosz2008b in the shaft, g 0.6: error %.1f%%, without sources %.1f%%\n", 100 * right, 100 * wrong);
  EXPECT_LT(right, 0.06);
  EXPECT_GT(wrong, 1);
}

/// Samples as they are without media, with shells that hold nothing.
HemisphereGather with_empty_shells(HemisphereGather g, int shells) {
  g.shells = shells;
  for (const GatherSample& s : g.samples) {
    g.layers.push_back({s.radiance, s.distance, {}});
    for (int l = 1; l <= shells; ++l) g.layers.push_back({{}, std::min(s.distance, 0.1f * static_cast<float>(l)), {}});
  }
  return g;
}

TEST(Jarosz2008b, WithoutMediaIsWardAndHeckberts) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, true);
  for (const FloorPoint& p : floor_points)
    for (const WallDistance distance : {WallDistance::minimum, WallDistance::harmonic, WallDistance::refined}) {
      HemisphereGather bare = gather_floor(room, p.x, p.y, {16, 50}, 7);
      bare.samples[100].distance = infinity;
      bare.samples[700].surface = GatherSample::own_surface;
      const Jet<Rgb> expected = ward_heckbert_1992(bare, RotationWeights::exact, distance);
      for (const HemisphereGather& g : {bare, with_empty_shells(bare, 0), with_empty_shells(bare, 12)}) {
        const Jet<Rgb> jet = jarosz_2008b(g, distance);
        EXPECT_EQ(jet.value, expected.value);
        EXPECT_EQ(jet.translational, expected.translational);
        EXPECT_EQ(jet.rotational, expected.rotational);
        EXPECT_EQ(jet.standard_error, expected.standard_error);
        EXPECT_EQ(jet.rays, expected.rays);
        EXPECT_EQ(jet.distances.harmonic_mean, expected.distances.harmonic_mean);
        EXPECT_EQ(jet.distances.obstacles, expected.distances.obstacles);
      }
    }
}

}  // namespace
}  // namespace isophote::test
