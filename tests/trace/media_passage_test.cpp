#include <gtest/gtest.h>

#include "isophote/scene/density_grid.h"
#include "isophote/trace/media.h"
#include "support/media.h"
#include "support/statistics.h"

namespace isophote {
namespace {

/// log T between two points, whose gradient by the first is compared with that of `along`.
double log_transmittance(const Media& media, const Vec3d& x, const Vec3d& y) {
  const Vec3d way = y - x;
  const float depth = static_cast<float>(length(way));
  Media::Passage passage;
  media.along({Vec3(x), Vec3(normalize(way)), 0, infinity}, {&depth, 1}, {&passage, 1});
  return std::log(static_cast<double>(passage.transmittance.g));
}

void expect_gradient(const Scene& scene, const Vec3d& x, const Vec3d& y, double tolerance) {
  const Media media(scene);
  const float depth = static_cast<float>(length(y - x));
  Media::Passage passage;
  media.along({Vec3(x), Vec3(normalize(y - x)), 0, infinity}, {&depth, 1}, {&passage, 1});
  constexpr double h = 0x1p-7;
  const auto slope = [&](const Vec3d& d) {
    return (log_transmittance(media, x + d * h, y) - log_transmittance(media, x - d * h, y)) / (2 * h);
  };
  EXPECT_NEAR(passage.log_gradient.x.g, slope({1, 0, 0}), tolerance);
  EXPECT_NEAR(passage.log_gradient.y.g, slope({0, 1, 0}), tolerance);
  EXPECT_NEAR(passage.log_gradient.z.g, slope({0, 0, 1}), tolerance);
}

Scene with(const Medium& medium) {
  Scene scene;
  scene.media.push_back(medium);
  return scene;
}

/// A smooth hump on a grid of n^3 points over the cube from -1 to 1.
GridDensity hump(int n) {
  std::vector<float> values;
  const auto at = [&](int i) { return 2.0f * static_cast<float>(i) / static_cast<float>(n - 1) - 1; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 p{at(i) - 0.1f, at(j) + 0.2f, at(k)};
        values.push_back(0.2f + std::exp(-3 * length_squared(p)));
      }
  const double size = 2.0 / (n - 1);
  Affine to_world;
  to_world.x = {size, 0, 0}, to_world.y = {0, size, 0}, to_world.z = {0, 0, size}, to_world.origin = {-1, -1, -1};
  return DensityGrid::from_values({n, n, n}, std::move(values), to_world);
}

TEST(MediaPassage, GradientsOfUniformMediaAcrossTheirBounds) {
  const Scene box = with(scenes::medium(Rgb(0.7f), Rgb(0.2f), {{-1, -1, -1}, {1, 1, 1}}));
  expect_gradient(box, {0.1, 0.2, -0.3}, {-0.4, 0.5, 0.6}, 2e-4);   // within
  expect_gradient(box, {0.1, 0.2, -0.3}, {2.4, 0.7, 0.9}, 2e-4);    // out of it
  expect_gradient(box, {-2.0, 0.2, -0.3}, {0.4, -0.5, 0.6}, 2e-4);  // into it
  expect_gradient(box, {-2.0, 0.2, -0.3}, {3.0, -0.5, 0.6}, 2e-4);  // through it
  Medium fog = scenes::medium(Rgb(0.7f), Rgb(0.2f), {});
  fog.bounds = scenes::closed_box({-1, -1, -1}, {1, 1, 1});
  expect_gradient(with(fog), {-2.0, 0.2, -0.3}, {3.0, -0.5, 0.6}, 2e-4);
}

TEST(MediaPassage, GradientsOfHeightFog) {
  Medium fog = scenes::medium(Rgb(0.7f), Rgb(0.2f), {{-2, -2, -2}, {2, 2, 2}});
  fog.density = HeightDensity{0.2f, 0.8f};
  expect_gradient(with(fog), {0.1, 0.2, -0.3}, {-0.4, 1.5, 0.6}, 3e-4);
  expect_gradient(with(fog), {0.1, 0.2, -0.3}, {-1.4, 0.2, 0.6}, 3e-4);
}

TEST(MediaPassage, GradientsOfGrids) {
  Medium smoke = scenes::medium(Rgb(0.9f), Rgb(0.2f), {{-1, -1, -1}, {1, 1, 1}});
  smoke.density = hump(33);
  // The step of the differences is a good part of a cell: their error is that.
  expect_gradient(with(smoke), {0.1, 0.2, -0.3}, {-0.4, 0.5, 0.6}, 5e-3);
  expect_gradient(with(smoke), {-0.71, -0.2, 0.33}, {0.4, -0.5, 0.6}, 5e-3);
}

TEST(MediaPassage, GridsAreTrackedAsTheyAreIntegrated) {
  Medium smoke = scenes::medium({0.9f, 1.5f, 2.0f}, Rgb(0.2f), {{-1, -1, -1}, {1, 1, 1}});
  smoke.density = hump(17);
  const Scene scene = with(smoke);
  const Media media(scene);
  const Ray ray{{-2, 0.1f, 0.2f}, normalize(Vec3{1, -0.1f, 0.05f}), 0, infinity};
  const float depth = infinity;
  Media::Passage passage;
  media.along(ray, {&depth, 1}, {&passage, 1});
  std::array<statistics::Estimate, 3> by_ratio, by_flight;
  for (int i = 0; i < 40000; ++i) {
    Sampler sampler(Purpose::test, 1, static_cast<std::uint64_t>(i), 0);
    Rgb throughput(1.0f), emission;
    const auto at = media.collide(ray, sampler, throughput, emission);
    const Rgb ratio = media.transmittance(ray, sampler.next_bits());
    for (int c = 0; c < 3; ++c) by_ratio[c].add(ratio[c]), by_flight[c].add(at ? 0 : throughput[c]);
  }
  for (int c = 0; c < 3; ++c) {
    statistics::expect_mean(by_ratio[c], passage.transmittance[c], 0.03);
    statistics::expect_mean(by_flight[c], passage.transmittance[c], 0.03);
  }
}

}  // namespace
}  // namespace isophote
