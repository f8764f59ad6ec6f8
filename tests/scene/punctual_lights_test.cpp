#include "isophote/scene/punctual_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

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
  LightSample s = PunctualLights(scene).sample({0, 0, 0}, 0.5f);
  EXPECT_TRUE(s.delta && s.sampled_directly);
  EXPECT_EQ(s.pdf, 1);
  EXPECT_EQ(s.distance, 2);
  EXPECT_EQ(s.radiance, (Rgb{2, 1, 0.5f}));
  EXPECT_EQ(s.direction, (Vec3{0, 1, 0}));

  scene.lights[0].range = 4;  // (1 - (2/4)^4) of it
  EXPECT_FLOAT_EQ(PunctualLights(scene).sample({0, 0, 0}, 0.5f).radiance.r, 2 * 15 / 16.0f);
  EXPECT_EQ(PunctualLights(scene).sample({0, -3, 0}, 0.5f).pdf, 0);

  scene.lights[0] = {PunctualLight::Kind::directional, "", {}, {0, -1, 0}, Rgb(3.0f)};
  s = PunctualLights(scene).sample({5, 6, 7}, 0.5f);
  EXPECT_EQ(s.radiance, Rgb(3.0f));
  EXPECT_EQ(s.direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(s.distance, infinity);

  scene.lights[0] = {PunctualLight::Kind::spot, "", {0, 2, 0}, {0, -1, 0}, Rgb(4.0f), 0.2f, 0.6f};
  const PunctualLights spot(scene);
  EXPECT_FLOAT_EQ(spot.sample({0, 0, 0}, 0.5f).radiance.r, 1);
  const float angle = 0.4f;
  const Vec3 aside{2 * std::tan(angle), 0, 0};
  const float edge = (std::cos(angle) - std::cos(0.6f)) / (std::cos(0.2f) - std::cos(0.6f));
  EXPECT_NEAR(spot.sample(aside, 0.5f).radiance.r, 4 / length_squared(aside - Vec3{0, 2, 0}) * edge * edge, 1e-5);
  EXPECT_EQ(spot.sample({2, 0, 0}, 0.5f).pdf, 0);
}

/// Over all u, each light is chosen as often as its pdf says, and what they bring over their chance is the sum of all.
void expect_the_sum(const Scene& scene, const Vec3& from) {
  const PunctualLights lights(scene);
  constexpr int draws = 1 << 16;
  double sum = 0, truth = 0;
  std::map<float, int> by_chance;
  for (int i = 0; i < draws; ++i) {
    const LightSample s = lights.sample(from, static_cast<float>(i) / draws);
    if (!(s.pdf > 0)) continue;
    ++by_chance[s.pdf];
    sum += s.radiance.g / s.pdf / draws;
  }
  for (const PunctualLight& light : scene.lights) truth += light.intensity.g / length_squared(light.position - from);
  EXPECT_NEAR(sum / truth, 1, 2e-3);
  if (scene.lights.size() >= 10) return;
  for (const auto& [chance, count] : by_chance) EXPECT_NEAR(count / double(draws), chance, 2e-5);
}

TEST(PunctualLights, FewAreChosenByWhatTheyBringAndManyByPower) {
  Scene scene;
  scene.lights = {point_light({0, 1, 0}, Rgb(0.1f)), point_light({0, 100, 0}, Rgb(500.0f)),
                  point_light({1, 0, 0}, Rgb(0)), point_light({3, 2, 0}, Rgb(2.0f))};
  expect_the_sum(scene, {});
  // What no light brings is brought by none: there is no noise but that of the light chosen.
  const PunctualLights lights(scene);
  const double irradiance = 0.1 + 0.05 + 2 / 13.0;
  for (const float u : {0.0f, 0.4f, 0.6f, 0.999f}) {
    const LightSample s = lights.sample({}, u);
    EXPECT_NEAR(s.radiance.r / s.pdf, irradiance, 1e-5);
  }
  for (int i = 0; i < 60; ++i)
    scene.lights.push_back(point_light({static_cast<float>(i), 50, 0}, Rgb(1 + 1e3f * static_cast<float>(i % 7 == 0))));
  expect_the_sum(scene, {});
}

TEST(PunctualLights, BlackOnesAreNone) {
  Scene scene;
  EXPECT_TRUE(PunctualLights(scene).empty());
  scene.lights = {point_light({0, 1, 0}, Rgb(0))};
  EXPECT_TRUE(PunctualLights(scene).empty());
}

}  // namespace
}  // namespace isophote
