#include "isophote/scene/punctual_lights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isophote {
namespace {

PunctualLight point_light(const Vec3& position, const Rgb& intensity) {
  PunctualLight light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

TEST(PunctualLights, HaveClosedForms) {
  Scene scene;
  scene.lights = {point_light({0, 2, 0}, {8, 4, 2})};
  LightSample s = PunctualLights(scene).sample(0, {0, 0, 0}, 0.5f);
  EXPECT_TRUE(s.delta && s.sampled_directly);
  EXPECT_EQ(s.pdf, 1);
  EXPECT_EQ(s.distance, 2);
  EXPECT_EQ(s.radiance, (Rgb{2, 1, 0.5f}));
  EXPECT_EQ(s.direction, (Vec3{0, 1, 0}));

  scene.lights[0].range = 4;  // (1 - (2/4)^4) of it
  EXPECT_FLOAT_EQ(PunctualLights(scene).sample(0, {0, 0, 0}, 0.5f).radiance.r, 2 * 15 / 16.0f);
  EXPECT_EQ(PunctualLights(scene).sample(0, {0, -3, 0}, 0.5f).pdf, 0);

  scene.lights[0] = {PunctualLight::Kind::directional, "", {}, {0, -1, 0}, Rgb(3.0f)};
  s = PunctualLights(scene).sample(0, {5, 6, 7}, 0.5f);
  EXPECT_EQ(s.radiance, Rgb(3.0f));
  EXPECT_EQ(s.direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(s.distance, infinity);

  scene.lights[0] = {PunctualLight::Kind::spot, "", {0, 2, 0}, {0, -1, 0}, Rgb(4.0f), 0.2f, 0.6f};
  const PunctualLights spot(scene);
  EXPECT_FLOAT_EQ(spot.sample(0, {0, 0, 0}, 0.5f).radiance.r, 1);
  const float angle = 0.4f;
  const Vec3 aside{2 * std::tan(angle), 0, 0};
  const float edge = (std::cos(angle) - std::cos(0.6f)) / (std::cos(0.2f) - std::cos(0.6f));
  EXPECT_NEAR(spot.sample(0, aside, 0.5f).radiance.r, 4 / length_squared(aside - Vec3{0, 2, 0}) * edge * edge, 1e-5);
  EXPECT_TRUE(is_black(spot.sample(0, {2, 0, 0}, 0.5f).radiance));
}

/// Over all u, each light is chosen as often as its pdf says, and what they bring over their chance is the sum of all.
void expect_the_sum(const Scene& scene) {
  const PunctualLights lights(scene);
  constexpr int draws = 1 << 16;
  double sum = 0, truth = 0;
  for (int i = 0; i < draws; ++i)
    for (int k = 0; k < lights.samples(); ++k) {
      const LightSample s = lights.sample(k, {}, (static_cast<float>(i) + 0.5f) / draws);
      if (!(s.pdf > 0) || is_black(s.radiance)) continue;
      sum += s.radiance.g / s.pdf / draws;
    }
  for (const PunctualLight& light : scene.lights) truth += light.intensity.g / length_squared(light.position);
  EXPECT_NEAR(sum / truth, 1, 2e-3);
}

/// Lights at distances from 1 to 10, every seventh much stronger, one black.
Scene lights(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i)
    scene.lights.push_back(point_light({0.1f, 1 + static_cast<float>(i % 10), 0}, Rgb(i % 7 == 0 ? 1e3f : 1)));
  scene.lights.back().intensity = Rgb(0);
  return scene;
}

TEST(PunctualLights, AllOfAFewAndOneOfMany) {
  for (const int count : {1, 2, 4, 5, 32, 33, 200}) {
    SCOPED_TRACE(count);
    const Scene scene = lights(count);
    EXPECT_EQ(PunctualLights(scene).samples(), count == 1 ? 0 : count <= 4 ? count : 1);
    if (count > 1) expect_the_sum(scene);
  }
}

TEST(PunctualLights, TheWeakestIsNotForgottenBesideTheStrongest) {
  for (const int count : {6, 40}) {
    Scene scene = lights(count);
    scene.lights[0].intensity = Rgb(1e12f);
    const PunctualLights all(scene);
    int weak = 0;
    constexpr int draws = 1 << 12;
    for (int i = 0; i < draws; ++i) {
      const LightSample s = all.sample(0, {}, static_cast<float>(i) / draws);
      weak += s.radiance.r < 1e6f;
      EXPECT_GT(s.pdf, 0.09f / static_cast<float>(count));
    }
    EXPECT_NEAR(weak / double(draws), 0.1, 0.025);
  }
}

TEST(PunctualLights, KindsAreChosenAmongThemselves) {
  Scene scene = lights(6);
  scene.lights.resize(8);
  for (int i = 6; i < 8; ++i) scene.lights[i] = {PunctualLight::Kind::directional, "", {}, {0, -1, 0}, Rgb(3.0f)};
  const PunctualLights all(scene), suns(scene, PunctualKinds::directional), placed(scene, PunctualKinds::placed);
  EXPECT_EQ(all.samples(), 1);
  EXPECT_EQ(suns.samples(), 2);
  EXPECT_EQ(placed.samples(), 1);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(suns.choose(i, 0.5f).light, &scene.lights[6 + static_cast<std::size_t>(i)]);
  for (int i = 0; i < 100; ++i) {
    const PunctualLights::Chosen one = placed.choose(0, (static_cast<float>(i) + 0.5f) / 100);
    EXPECT_EQ(one.light->kind, PunctualLight::Kind::point);
    EXPECT_GT(one.chance, 0);
  }
}

TEST(PunctualLights, BlackOnesAreNone) {
  Scene scene;
  EXPECT_EQ(PunctualLights(scene).samples(), 0);
  scene.lights = {point_light({0, 1, 0}, Rgb(0))};
  EXPECT_EQ(PunctualLights(scene).samples(), 0);
}

}  // namespace
}  // namespace isophote
