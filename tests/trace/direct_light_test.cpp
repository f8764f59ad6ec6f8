#include <gtest/gtest.h>

#include <cmath>

#include "isophote/sampling/warp.h"
#include "lit_floor.h"
#include "render.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;
using statistics::expect_same_mean;

/// Irradiance under the middle of that lamp, by the form factor of a rectangle seen from below its corner, four times.
double lamp_irradiance(double height) {
  const double x = 0.5 / height, s = std::sqrt(1 + x * x);
  return 3 * 4 * 0.5 * (2 * x / s * std::atan(x / s));
}

TEST(DirectLight, PunctualLightsAreExact) {
  Scene scene = floor_of(scenes::diffuse({0.8f, 0.4f, 0.2f}));
  PunctualLight light;
  light.position = {3, 4, 0};
  light.intensity = {50, 25, 10};
  scene.lights.push_back(light);
  Stage stage(scene);
  const SurfacePoint point = stage.hit({0, 1, 0}, {0, -1, 0});
  const float e = 50 / 25.0f * 0.8f;  // I cos / d^2
  Sampler sampler = test_sampler(1, 0);
  const Scattered s = scatter(stage.world, point, {0, 1, 0}, 0, sampler, stage.counts);
  EXPECT_NEAR(s.direct.r, 0.8f / pi * e, 1e-6);
  EXPECT_NEAR(s.direct.g, 0.4f / pi * e / 2, 1e-6);
  EXPECT_TRUE(is_black(s.indirect));
  EXPECT_NEAR(direct_light(stage.world, point, {0, 1, 0}, false, sampler, stage.counts).r, 0.8f / pi * e, 1e-6);
}

TEST(DirectLight, DirectionalLightIsExactAndShadowed) {
  Scene scene = floor_of(scenes::diffuse(Rgb(0.5f)));
  PunctualLight light;
  light.kind = PunctualLight::Kind::directional;
  light.direction = normalize(Vec3{0, -1, -1});
  light.intensity = Rgb(2.0f);
  scene.lights.push_back(light);
  scene.meshes.push_back(scenes::quad({-1, 3, 2}, {2, 0, 0}, {0, 0, 2}, 0));  // shadows z in [-1, 1]
  Stage stage(scene);
  Sampler sampler = test_sampler(1, 0);
  EXPECT_TRUE(
      is_black(scatter(stage.world, stage.hit({0, 1, 0}, {0, -1, 0}), {0, 1, 0}, 0, sampler, stage.counts).direct));
  const Scattered lit = scatter(stage.world, stage.hit({3, 1, 0}, {0, -1, 0}), {0, 1, 0}, 0, sampler, stage.counts);
  EXPECT_NEAR(lit.direct.g, 0.5f / pi * 2 * std::sqrt(0.5f), 1e-6);
}

/// Direct light as `scatter` has it, and as its parts of which the cached integrator is made.
struct DirectLight {
  Estimate whole, parts;

  DirectLight(Stage& stage, const SurfacePoint& point, const Vec3& wo, int samples) {
    for (int i = 0; i < samples; ++i) {
      Sampler a = test_sampler(1, i), b = test_sampler(2, i);
      whole.add(scatter(stage.world, point, wo, 0, a, stage.counts).direct.g);
      const double d = direct_light(stage.world, point, wo, false, b, stage.counts).g;
      parts.add(d + glossy_ray(stage.world, point, wo, b, stage.counts).direct.g);
    }
  }
};

/// A lamp and punctual lights add up, on a diffuse floor and on metal, for `scatter` and for its parts; also where one
/// of them is hidden, and however strong that one is.
TEST(DirectLight, LampsAndPunctualLightsAddUp) {
  for (const Material& floor : {scenes::diffuse({0.8f, 0.4f, 0.2f}), scenes::metal({0.9f, 0.6f, 0.3f}, 0.5f)}) {
    const Vec3 wo = normalize(Vec3{0.6f, 0.8f, 0});
    const auto direct = [&](bool lamp, bool bulb, bool sun) {
      Scene scene = lamp ? floor_with_lamp(floor, 2) : floor_of(floor);
      scene.meshes.push_back(scenes::quad({-9, 5, -9}, {18, 0, 0}, {0, 0, 18}, 0));  // a roof, which hides the sun
      if (bulb) scene.lights.emplace_back().position = {-1.5f, 2, 0.1f};
      if (sun) {
        PunctualLight& light = scene.lights.emplace_back();
        light.kind = PunctualLight::Kind::directional, light.direction = {0, -1, 0}, light.intensity = Rgb(1e9f);
      }
      Stage stage(std::move(scene));
      const SurfacePoint point = stage.hit(wo * 0.5f, -wo);
      const DirectLight seen(stage, point, wo, 40000);
      expect_same_mean(seen.whole, seen.parts, 0.02);
      return seen.whole.mean();
    };
    const double lamp = direct(true, false, false), bulb = direct(false, true, false);
    EXPECT_GT(bulb, 0.01);
    EXPECT_NEAR(direct(true, true, false) / (lamp + bulb), 1, 0.01);
    EXPECT_NEAR(direct(true, true, true) / (lamp + bulb), 1, 0.01);
  }
}

TEST(DirectLight, LampMatchesItsFormFactor) {
  struct Case {
    float height;
    int parts;  // of the lamp's sides
  };
  for (const auto& [height, parts] :
       {Case{2, 1}, Case{2, 5}, Case{0.6f, 1}, Case{0.6f, 5}, Case{0.05f, 1}, Case{0.05f, 5}}) {
    Scene scene = floor_with_lamp(scenes::diffuse(Rgb(0.5f)), height);
    if (parts > 1) scene.meshes.back() = scenes::divided(scene.meshes.back(), parts);
    Stage stage(scene);
    const SurfacePoint point = stage.hit({0, 0.5f * height, 0}, {0, -1, 0});
    EXPECT_EQ(stage.emitters.near(point.position), height < 0.3f) << height;
    Estimate all, diffuse;
    for (int i = 0; i < 40000; ++i) {
      Sampler a = test_sampler(1, i), b = test_sampler(2, i);
      all.add(scatter(stage.world, point, {0, 1, 0}, 0, a, stage.counts).direct.g);
      diffuse.add(direct_light(stage.world, point, {0, 1, 0}, false, b, stage.counts).g);
    }
    const double truth = 0.5 / M_PI * lamp_irradiance(height);
    expect_mean(all, truth, 0.01);
    expect_mean(diffuse, truth, 0.01);
  }
}

TEST(DirectLight, LampsShineToTheFrontUnlessDoubleSided) {
  for (const bool double_sided : {false, true}) {
    Stage stage(floor_with_lamp(scenes::diffuse(Rgb(0.5f)), -1, double_sided));  // under the floor, back side up
    const SurfacePoint below = stage.hit({0, -0.5f, 0}, {0, 1, 0});
    Estimate e;
    for (int i = 0; i < 20000; ++i) {
      Sampler sampler = test_sampler(1, i);
      e.add(scatter(stage.world, below, {0, -1, 0}, 0, sampler, stage.counts).direct.g);
    }
    if (double_sided) {
      expect_mean(e, 0.5 / M_PI * lamp_irradiance(1), 0.01);
    } else {
      EXPECT_EQ(e.mean(), 0);
    }
    Sampler sampler = test_sampler(1, 0);
    const FirstPoint seen = first_point(stage.world, {{0, -0.2f, 0}, {0, -1, 0}}, true, sampler, stage.counts.camera);
    EXPECT_EQ(seen.emission.g, double_sided ? 3 : 0);
  }
}

/// What `scatter` calls direct, by light sampling alone and by BSDF sampling alone, from public pieces.
struct SingleStrategies {
  Estimate light, bsdf;
  statistics::Random random{17};

  SingleStrategies(Stage& stage, const SurfacePoint& point, const Vec3& wo, int samples) {
    const Bsdf& b = point.bsdf;
    const auto lit_side = [&](const Vec3& wi) { return dot(wi, b.frame.n) > 0 && dot(wi, point.geometric_normal) > 0; };
    for (int i = 0; i < samples; ++i) {
      const float choice = random.next();
      const LightSample s = stage.emitters.sample(point.position, choice, random.next2());
      double value = 0;
      if (s.pdf > 0 && s.sampled_directly && lit_side(s.direction)) {
        const Ray ray{offset_origin(point, s.direction), s.direction, 0, s.distance * (1 - 1e-4f)};
        const Rgb f = diffuse_albedo(b, wo) * (dot(s.direction, b.frame.n) / pi) + evaluate_glossy(b, wo, s.direction);
        if (!stage.rays.occluded(ray, seed())) value = f.g * s.radiance.g / s.pdf;
      }
      light.add(value);

      const Vec3 cosine = b.frame.to_world(cosine_hemisphere(random.next2()));
      const BsdfSample glossy = sample_glossy(b, wo, random.next2());
      bsdf.add(diffuse_albedo(b, wo).g * lamp_along(stage, point, cosine) +
               glossy.weight.g * lamp_along(stage, point, glossy.direction));
    }
  }

 private:
  std::uint32_t seed() { return static_cast<std::uint32_t>(random.next() * 0x1p24f); }
  double lamp_along(Stage& stage, const SurfacePoint& point, const Vec3& d) {
    if (!(dot(d, point.geometric_normal) > 0)) return 0;
    const Ray ray{offset_origin(point, d), d};
    Hit hit;
    if (stage.rays.intersect(ray, seed(), hit)) return surface_point(stage.scene, ray, hit).emission.g;
    const Emitters::Sky sky = stage.emitters.environment(d);
    return sky.sampled_directly ? sky.radiance.g : 0;
  }
};

/// A shiny floor under a lamp and a sky with peaks.
Scene shiny_floor_with_lamp(float roughness) {
  Scene scene = floor_with_lamp(shiny(roughness), 0.8f);
  scene.environment.radiance = RgbImage(32, 16, Rgb(0.01f));
  for (int x = 8; x < 12; ++x) scene.environment.radiance.at(x, 5) = Rgb(6.0f);
  return scene;
}

void expect_equal_strategies(Scene scene) {
  Stage stage(std::move(scene));
  const Vec3 wo = normalize(Vec3{0.8f, 0.6f, 0.1f});
  const SurfacePoint point = stage.hit(Vec3{0.3f, 0, 0} + wo * 0.5f, -wo);
  const SingleStrategies single(stage, point, wo, 300000);
  const DirectLight mis(stage, point, wo, 100000);
  expect_same_mean(mis.whole, single.light, 0.01);
  expect_same_mean(mis.whole, single.bsdf, 0.02);
  expect_same_mean(mis.whole, mis.parts, 0.01);
}

TEST(DirectLight, MisEqualsEachSingleStrategy) {
  for (const float roughness : {0.3f, 0.8f}) expect_equal_strategies(shiny_floor_with_lamp(roughness));
}

/// 4 x 2 texels: a bright and a dark half in alternating rows, with a hole.
Texture lamp_texture() {
  Texture texture;
  texture.width = 4, texture.height = 2;
  for (const int value : {255, 20, 20, 200, 40, 255, 128, 0})
    for (int channel = 0; channel < 4; ++channel) texture.rgba.push_back(static_cast<std::uint8_t>(value));
  return texture;
}

TEST(DirectLight, MisEqualsEachSingleStrategyForATexturedLamp) {
  Scene scene = shiny_floor_with_lamp(0.5f);
  scene.textures.push_back(lamp_texture());
  scene.materials[1].emission_texture.texture = 0;
  scene.materials[1].emission_texture.matrix = {1.5f, 0.5f, 0.1f, -0.5f, 1, 0};
  expect_equal_strategies(scene);
}

TEST(DirectLight, MisEqualsEachSingleStrategyForALampWithHoles) {
  for (const Alpha alpha : {Alpha::mask, Alpha::blend}) {
    Scene scene = shiny_floor_with_lamp(0.5f);
    scene.textures.push_back(lamp_texture());
    scene.materials[1].base_color_texture.texture = 0;
    scene.materials[1].alpha = alpha;
    expect_equal_strategies(scene);
  }
}

TEST(DirectLight, GlossyRayAndIrradianceMakeUpScatter) {
  // indirect = diffuse_albedo / pi * irradiance + the glossy ray's weight * what it brings.
  Scene scene = scenes::cornell_box();
  Material& white = scene.materials[0];
  white.specular = 1;
  white.ior = 2;
  white.roughness = 0.4f;
  scene.environment.radiance = RgbImage(8, 4, Rgb(0.5f));
  Stage stage(scene);
  const Vec3 wo = normalize(Vec3{-0.5f, 0.7f, 0.4f});
  const SurfacePoint point = stage.hit(Vec3{0.2f, 0, 0.8f} + wo * 0.1f, -wo);
  Estimate whole, parts;
  for (int i = 0; i < 200000; ++i) {
    Sampler a = test_sampler(1, i), b = test_sampler(2, i);
    const Scattered s = scatter(stage.world, point, wo, 0, a, stage.counts);
    whole.add(s.indirect.g);
    const GlossyRay g = glossy_ray(stage.world, point, wo, b, stage.counts);
    Rgb brought = g.next.emission;
    if (g.next.point) {
      const Scattered next = scatter(stage.world, *g.next.point, -g.next.direction, 1, b, stage.counts);
      brought += g.next.throughput * (next.direct + next.indirect);
    }
    parts.add(s.irradiance.g * diffuse_albedo(point.bsdf, wo).g / pi + (g.weight * brought).g);
  }
  expect_same_mean(whole, parts, 0.01);
}

TEST(FirstPoint, CountsLampsWhereAskedAndSkyAlways) {
  Scene scene = floor_with_lamp(scenes::diffuse(Rgb(0.5f)), 1);
  scene.environment.radiance = RgbImage(8, 4, Rgb(2.0f));
  Stage stage(scene);
  Sampler sampler = test_sampler(1, 0);
  std::uint64_t rays = 0;
  const Ray up{{0, 0.5f, 0}, {0, 1, 0}}, away{{2, 0.5f, 0}, {0, 1, 0}};
  EXPECT_EQ(first_point(stage.world, up, true, sampler, rays).emission.g, 3);
  EXPECT_EQ(first_point(stage.world, up, false, sampler, rays).emission.g, 0);
  for (const bool see_lamps : {false, true}) {
    const FirstPoint sky = first_point(stage.world, away, see_lamps, sampler, rays);
    EXPECT_EQ(sky.emission.g, 2);
    EXPECT_FALSE(sky.point);
    EXPECT_EQ(sky.first_distance, infinity);
  }
  EXPECT_EQ(rays, 4u);
  const FirstPoint floor = first_point(stage.world, {{2, 0.5f, 0}, {0, -1, 0}}, false, sampler, rays);
  ASSERT_TRUE(floor.point);
  EXPECT_FLOAT_EQ(floor.first_distance, 0.5f);
  EXPECT_FLOAT_EQ(floor.path_length, 0.5f);
  EXPECT_EQ(floor.first_normal, (Vec3{0, 1, 0}));
  EXPECT_EQ(floor.first_mesh, 0u);
  EXPECT_EQ(floor.depth, 0);
}

}  // namespace
}  // namespace isophote
