#include "isophote/validity/split_sphere.h"

#include <gtest/gtest.h>

#include <numbers>

#include "isophote/validity/uniform.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

Jet<Rgb> jet_at(float harmonic_mean) {
  Jet<Rgb> jet;
  jet.value = Rgb(1);
  jet.distances.harmonic_mean = harmonic_mean;
  return jet;
}

/// The error that a footprint gives a query at distance d whose normal is turned by `angle`: under 1 inside.
double error(const Footprint& f, double d, double angle) {
  return std::sqrt(quadratic_form(f.shape, Vec3(Vec3d(d, 0, 0)))) +
         f.normal_scale * length(Vec3d(std::sin(angle), 0, std::cos(angle)) - Vec3d(0, 0, 1)) / std::sqrt(2.0);
}

// The footprint's error is the published one over a, and inside means eps < a.
TEST(SplitSphere, IsThePublishedError) {
  RandomPlaces random(1);
  int inside = 0;
  for (int i = 0; i < 10000; ++i) {
    const float r = random.number(0.1f, 10), a = random.number(0.05f, 0.5f);
    const double d = random.number(0, 1) * r * a, angle = random.number(0, 1) * a;
    const Footprint f = split_sphere(jet_at(r).distances, {.pixel = 0.01f, .scene_scale = 100}, a);
    const double eps = 4 / std::numbers::pi * d / r + std::sqrt(1 - std::cos(angle));
    EXPECT_NEAR(error(f, d, angle), eps / a, 1e-5);
    inside += eps < a;
    EXPECT_EQ(f.falloff, Falloff::ward);
    EXPECT_EQ(f.unscaled, r);
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, 9000);
}

TEST(SplitSphere, RadiusIsWhereDistanceAloneReachesA) {
  const Footprint f = split_sphere(jet_at(2).distances, {.pixel = 0.01f, .scene_scale = 100}, 0.2f);
  EXPECT_FLOAT_EQ(f.radius, 2 * 0.2f * std::numbers::pi_v<float> / 4);
  EXPECT_NEAR(error(f, f.radius, 0), 1, 1e-6);
}

TEST(SplitSphere, UnderAnOpenSkyTheSceneIsTheDistance) {
  const Footprint f = split_sphere(jet_at(infinite).distances, {.pixel = 0.01f, .scene_scale = 8}, 0.2f);
  EXPECT_FLOAT_EQ(f.radius, split_sphere_radius(8, 0.2f));
  EXPECT_EQ(f.unscaled, 8);
}

TEST(Uniform, IsOneRadiusWhateverIsSeen) {
  const View view{.pixel = 0.01f, .scene_scale = 5};
  const Footprint f = uniform(view, 0.3f);
  EXPECT_FLOAT_EQ(f.radius, 0.15f);
  EXPECT_NEAR(error(f, 0.15, 0), 1, 1e-6);
  EXPECT_FLOAT_EQ(f.normal_scale, 1 / 0.3f);
  EXPECT_EQ(f.falloff, Falloff::tent);
  EXPECT_FLOAT_EQ(uniform({.pixel = 1, .scene_scale = 5}, 0.6f).radius, 0.3f);
}

TEST(Footprint, ResizeKeepsItsBoundsAndItsShape) {
  Footprint f = Footprint::disk(1, 1);
  f.shape.yy = 4;  // an ellipse of half the width along y
  f.smallest = 0.25f;
  f.largest = 3;
  f.resize(2);
  EXPECT_FLOAT_EQ(f.radius, 2);
  EXPECT_FLOAT_EQ(quadratic_form(f.shape, {2, 0, 0}), 1);
  EXPECT_FLOAT_EQ(quadratic_form(f.shape, {0, 1, 0}), 1);
  f.resize(100);
  EXPECT_FLOAT_EQ(f.radius, 3);
  f.resize(0);
  EXPECT_FLOAT_EQ(f.radius, 0.25f);
  EXPECT_FLOAT_EQ(quadratic_form(f.shape, {0, 0.125f, 0}), 1);
}

}  // namespace
}  // namespace isophote::test
