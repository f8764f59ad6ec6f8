#include "isophote/trace/placed_lights.h"

#include <gtest/gtest.h>

#include "isophote/scene/phase.h"
#include "isophote/scene/punctual_lights.h"
#include "isophote/trace/density_walk.h"
#include "isophote/trace/shadow.h"
#include "render.h"
#include "support/media.h"

namespace isophote {
namespace {

using statistics::Estimate;

PunctualLight light_at(const Vec3& position) {
  PunctualLight light;
  light.position = position;
  light.intensity = {3, 2, 1};
  return light;
}
PunctualLight spot_at(const Vec3& position, const Vec3& towards, float inner, float outer) {
  PunctualLight light = light_at(position);
  light.kind = PunctualLight::Kind::spot;
  light.direction = normalize(towards - position);
  light.inner_cone = inner, light.outer_cone = outer;
  return light;
}

/// Two media that overlap, one of which thins with height, and a block that throws a shadow.
Scene fog() {
  Scene scene;
  scene.media.push_back(scenes::medium({0.3f, 0.2f, 0.1f}, Rgb(0.1f), {{-2, -2, -2}, {2, 2, 2}}, 0.5f));
  scene.media.push_back(scenes::medium(Rgb(0.4f), Rgb(0.05f), {{-1, -3, -3}, {1, 3, 3}}, -0.3f));
  scene.media.back().density = HeightDensity{0, 0.7f};
  const auto grey = scenes::add(scene, scenes::diffuse(Rgb(0.5f)));
  scene.meshes.push_back(scenes::box({-0.6f, -0.3f, 0.1f}, {-0.3f, 0.2f, 0.4f}, false, grey));
  return scene;
}

/// The integral along a ray, by as many steps; as if that came to its places from `direction`.
double integral(Stage& stage, const Ray& ray, int steps, const Vec3& direction) {
  double sum = 0;
  const float step = (ray.far - ray.near) / static_cast<float>(steps);
  for (int i = 0; i < steps; ++i) {
    const float t = ray.near + (static_cast<float>(i) + 0.5f) * step;
    const Vec3 p = ray.origin + ray.direction * t;
    const double before = stage.media.transmittance({ray.origin, ray.direction, ray.near, t}, 0).g;
    const std::uint32_t held = stage.media.holding(p);
    for (std::uint32_t m = 0; m < stage.scene.media.size(); ++m) {
      if (!(held >> m & 1)) continue;
      const Medium& medium = stage.scene.media[m];
      const double sigma = medium.scattering.g * density_at(medium, p);
      for (const PunctualLight& light : stage.scene.lights) {
        const LightSample sample = punctual_light_at(light, p);
        if (is_black(sample.radiance)) continue;
        const Rgb arrives = light_transmittance(
            stage.world, ShadowStart(MediumPoint{p, medium.g, m, {}}, sample.direction), sample, 0, stage.counts);
        const double phase = henyey_greenstein(medium.g, dot(direction, sample.direction));
        sum += static_cast<double>(step) * before * sigma * phase * static_cast<double>(sample.radiance.g * arrives.g);
      }
    }
  }
  return sum;
}

/// Estimates along rays of many directions from one place.
void expect_integrals(Scene scene, std::uint64_t seed, double power) {
  Stage stage(std::move(scene));
  statistics::Random random(static_cast<unsigned>(seed));
  for (int r = 0; r < 6; ++r) {
    const Vec3 aim{random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.5f};
    const Vec3 origin{-2.5f, 0.3f, 0.2f};
    const Ray ray{origin, normalize(aim - origin), 0, r % 2 ? 6.0f : 3.0f};
    Estimate e;
    for (int i = 0; i < 40000; ++i) {
      Sampler sampler = test_sampler(seed + static_cast<std::uint64_t>(r), i);
      e.add(placed_lights_along(stage.world, ray, {}, sampler, stage.counts).g);
    }
    const double expected = integral(stage, ray, 20000, ray.direction);
    EXPECT_LE(e.standard_error(), power * expected) << r;
    EXPECT_NEAR(e.mean(), expected, 4.5 * e.standard_error() + 2e-3 * expected) << r;
  }
}

TEST(PlacedLights, PointLights) {
  Scene scene = fog();
  scene.lights = {light_at({0.1f, 0.4f, -0.2f}), light_at({-0.9f, -0.2f, 0.3f})};
  expect_integrals(std::move(scene), 1, 0.01);
}

TEST(PlacedLights, OnlyWithinConesOfSpots) {
  for (const float outer : {0.2f, 0.9f, 1.57f}) {
    Scene scene = fog();
    scene.lights = {spot_at({0.2f, 1.2f, -0.3f}, {0, 0, 0}, 0.5f * outer, outer)};
    expect_integrals(std::move(scene), 20, 0.01);
  }
}

TEST(PlacedLights, TheSlopeIsThatOfPhaseFunctions) {
  Scene scene = fog();
  scene.lights = {light_at({0.3f, 1.2f, -0.2f})};
  Stage stage(std::move(scene));
  const Ray ray{{-2.5f, 0.3f, 0.2f}, normalize(Vec3{2.4f, -0.2f, -0.3f}), 0, 4};
  const Vec3 to_light = stage.scene.lights[0].position - ray.origin;
  const Vec3 across = normalize(to_light - ray.direction * dot(ray.direction, to_light));
  Estimate e;
  for (int i = 0; i < 20000; ++i) {
    Sampler sampler = test_sampler(60, i);
    LightChange change;
    placed_lights_along(stage.world, ray, {}, sampler, stage.counts, &change);
    e.add(change.turn.dot(across).g);
  }
  constexpr float angle = 0.01f;
  const auto turned = [&](float by) { return normalize(ray.direction + across * by); };
  const double expected =
      (integral(stage, ray, 20000, turned(angle)) - integral(stage, ray, 20000, turned(-angle))) / (2 * double{angle});
  EXPECT_NEAR(e.mean(), expected, 4.5 * e.standard_error() + 3e-3 * std::abs(expected));
  EXPECT_GT(std::abs(expected), 20 * e.standard_error());
}

TEST(PlacedLights, OneOfManyIsChosen) {
  Scene scene = fog();
  for (int i = 0; i < 7; ++i) scene.lights.push_back(light_at({0.25f * static_cast<float>(i) - 0.8f, 0.8f, -0.6f}));
  scene.lights.push_back(spot_at({0.2f, 1.2f, -0.3f}, {0, 0, 0}, 0.3f, 0.5f));
  expect_integrals(std::move(scene), 40, 0.02);
}

// What collisions cannot do: near the light the estimate is as good as far from it.
TEST(PlacedLights, ARayCloseToALight) {
  Scene scene;
  scene.media.push_back(scenes::medium(Rgb(0.3f), Rgb(0.1f), {{-2, -2, -2}, {2, 2, 2}}));
  scene.lights = {light_at({0, 0, 0})};
  Stage stage(std::move(scene));
  for (const float height : {0.5f, 0.01f, 1e-4f}) {
    Estimate e;
    for (int i = 0; i < 4000; ++i) {
      Sampler sampler = test_sampler(70, i);
      e.add(placed_lights_along(stage.world, {{-2, height, 0}, {1, 0, 0}, 0, 4}, {}, sampler, stage.counts).g);
    }
    EXPECT_LE(e.standard_error(), 0.006 * e.mean());
    // Close by, pi / height of the light's inverse square, less what is lost on the way.
    if (height < 0.1f) {
      EXPECT_NEAR(e.mean() * height, 0.3 * 2 / (4 * M_PI) * M_PI * std::exp(-0.4 * 2), 0.02 * e.mean() * height + 0.01);
    }
  }
  Sampler sampler = test_sampler(71, 0);
  const Rgb through = placed_lights_along(stage.world, {{-2, 0, 0}, {1, 0, 0}, 0, 4}, {}, sampler, stage.counts);
  EXPECT_TRUE(is_finite(through));
}

TEST(PlacedLights, NothingWithoutMediaOrLightsWithPlaces) {
  Scene scene = fog();
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  scene.lights = {sun};
  Stage stage(std::move(scene));
  Sampler sampler = test_sampler(72, 0);
  EXPECT_TRUE(is_black(placed_lights_along(stage.world, {{-2, 0, 0}, {1, 0, 0}, 0, 4}, {}, sampler, stage.counts)));
  EXPECT_EQ(stage.counts.total(), 0u);
}

}  // namespace
}  // namespace isophote
