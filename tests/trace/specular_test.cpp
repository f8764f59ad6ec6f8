#include <gtest/gtest.h>

#include <cmath>

#include "render.h"
#include "support/scenes.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

/// A slab of glass, 1 thick, between z = 0 and z = 1, before a black-bodied lamp of radiance 1 at z = -2.
Scene slab(const Material& glass) {
  Scene scene;
  scene.meshes.push_back(scenes::box({-9, -9, 0}, {9, 9, 1}, false, scenes::add(scene, glass)));
  scene.meshes.push_back(
      scenes::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1.0f)))));
  return scene;
}

TEST(Specular, SlabTransmitsByFresnelAndBeerLambert) {
  Material glass = scenes::glass(1.5f);
  glass.attenuation_color = {0.5f, 1, 0.9f};
  glass.attenuation_distance = 0.5f;
  Stage stage(slab(glass));
  Estimate r, g;
  for (int i = 0; i < 200000; ++i) {
    Sampler sampler = test_sampler(1, i);
    const FirstPoint first =
        first_point(stage.world, {{0.3f, 0.2f, 3}, {0, 0, -1}}, true, sampler, stage.counts.camera);
    r.add(first.emission.r);
    g.add(first.emission.g);
  }
  // Reflections back and forth inside: (1-R)^2 t / (1 - R^2 t^2).
  const double reflectance = 0.04, absorbed = 0.25;
  const auto through = [&](double t) { return std::pow(1 - reflectance, 2) * t / (1 - std::pow(reflectance * t, 2)); };
  expect_mean(r, through(absorbed), 0.005);
  expect_mean(g, through(1), 0.005);
}

TEST(Specular, LampSeenThroughGlassCountsEvenForGatherRays) {
  Stage stage(slab(scenes::glass(1.5f)));
  Estimate e;
  for (int i = 0; i < 50000; ++i) {
    Sampler sampler = test_sampler(2, i);
    e.add(first_point(stage.world, {{0.3f, 0.2f, 3}, {0, 0, -1}}, false, sampler, stage.counts.gather).emission.g);
  }
  expect_mean(e, 0.96 * 0.96 / (1 - 0.0016), 0.005);
}

TEST(Specular, SlabDisplacesButDoesNotTurn) {
  Stage stage(slab(scenes::glass(1.5f)));
  const Vec3 d = normalize(Vec3{0.6f, 0, -0.8f});
  bool passed = false;
  for (int i = 0; i < 20; ++i) {
    Sampler sampler = test_sampler(3, i);
    const FirstPoint first = first_point(stage.world, {{0, 0, 2}, d}, true, sampler, stage.counts.camera);
    if (first.depth != 2 || !first.point) continue;
    passed = true;
    EXPECT_LT(length(first.direction - d), 1e-5f);
    // 3 outside at tan 0.75, 1 inside by Snell.
    const double inside = 0.6 / 1.5, tan_inside = inside / std::sqrt(1 - inside * inside);
    EXPECT_NEAR(first.point->position.x, 3 * 0.75 + tan_inside, 1e-4);
    EXPECT_NEAR(first.path_length, 3 / 0.8 + 1 / std::sqrt(1 - inside * inside), 1e-4);
    EXPECT_NEAR(first.first_distance, 1 / 0.8, 1e-4);
    EXPECT_LT(length(first.first_normal - Vec3{0, 0, 1}), 1e-6f);
  }
  EXPECT_TRUE(passed);
}

TEST(Specular, AbsorptionReachesWhatIsInsideTheGlass) {
  // A lamp embedded in the slab, half way: the ray crosses 0.5 of glass. Radiance inside glass is weighed by 1/n^2.
  Material glass = scenes::glass(1.5f);
  glass.attenuation_color = Rgb(0.5f);
  glass.attenuation_distance = 1;
  Scene scene;
  scene.meshes.push_back(scenes::box({-9, -9, 0}, {9, 9, 1}, false, scenes::add(scene, glass)));
  scene.meshes.push_back(
      scenes::quad({-8, -8, 0.5f}, {16, 0, 0}, {0, 16, 0}, scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1.0f)))));
  Stage stage(scene);
  Estimate e;
  for (int i = 0; i < 50000; ++i) {
    Sampler sampler = test_sampler(4, i);
    e.add(first_point(stage.world, {{0.3f, 0.2f, 3}, {0, 0, -1}}, true, sampler, stage.counts.camera).emission.g);
  }
  expect_mean(e, 0.96 * std::sqrt(0.5) / 2.25, 0.005);
}

TEST(Specular, MirrorsTintAndChain) {
  Scene scene;
  const int mirror = scenes::add(scene, scenes::metal({0.5f, 1, 0.25f}, 0));
  const int lamp = scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(4.0f)));
  scene.meshes = {scenes::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, mirror),
                  scenes::quad({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, lamp)};
  Stage stage(scene);
  Sampler sampler = test_sampler(5, 0);
  const FirstPoint first =
      first_point(stage.world, {{0.1f, 0, 1}, normalize(Vec3{0.1f, 0, -1})}, false, sampler, stage.counts.camera);
  const float grazing = std::pow(1 - 1 / std::sqrt(1.01f), 5.0f);
  EXPECT_NEAR(first.emission.r, 4 * (0.5f + 0.5f * grazing), 1e-5);
  EXPECT_NEAR(first.emission.b, 4 * (0.25f + 0.75f * grazing), 1e-5);
  EXPECT_EQ(first.depth, 1);
  stage.world.max_depth = 0;
  EXPECT_TRUE(
      is_black(first_point(stage.world, {{0.1f, 0, 1}, {0, 0, -1}}, true, sampler, stage.counts.camera).emission));
}

TEST(Specular, ChainsBetweenPerfectMirrorsEnd) {
  Stage stage(scenes::room(scenes::metal(Rgb(1.0f), 0)));
  for (int i = 0; i < 1000; ++i) {
    Sampler sampler = test_sampler(6, i);
    EXPECT_FALSE(
        first_point(stage.world, {{0, 0, 0}, normalize(Vec3{0.3f, 0.5f, -0.7f})}, true, sampler, stage.counts.camera)
            .point);
  }
  EXPECT_LT(stage.counts.camera, 1000u * 60);
}

TEST(Specular, SmoothPlasticIsSharedBetweenMirrorAndDiffuse) {
  // Under a sky of radiance 1 the two together reflect F + (1 - F) a.
  Material plastic = scenes::diffuse(Rgb(0.5f));
  plastic.specular = 1;
  plastic.roughness = 0;
  Scene scene;
  scene.meshes.push_back(scenes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, scenes::add(scene, plastic)));
  scene.environment.radiance = RgbImage(16, 8, Rgb(1.0f));
  Stage stage(scene);
  Estimate e;
  for (int i = 0; i < 50000; ++i) {
    Sampler sampler = test_sampler(7, i);
    const Scattered s = stage.radiance({{0, 1, 0.1f}, {0, -1, 0}}, sampler);
    e.add(s.direct.g + s.indirect.g);
  }
  expect_mean(e, 0.04 + 0.96 * 0.5, 0.005);
}

}  // namespace
}  // namespace isophote
