#include <gtest/gtest.h>

#include "isophote/sampling/warp.h"
#include "render.h"
#include "support/scenes.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

Ray camera_ray(const Scene& scene, Sampler& sampler) {
  const Vec2 u = sampler.next2();
  return scene.cameras[0].ray(u.x * 64, u.y * 64, 64, 64);
}

TEST(Furnace, ClosedRoomGlowsByTheGeometricSeries) {
  // Emission e, albedo a: radiance e / (1 - a); emission and one scattering are direct, the rest indirect.
  for (const float a : {0.2f, 0.5f, 0.8f}) {
    Stage stage(scenes::room(scenes::emissive(Rgb(a), Rgb(1.0f))));
    Estimate direct, indirect, irradiance;
    for (int i = 0; i < 20000; ++i) {
      Sampler sampler = test_sampler(1, i);
      const Ray ray = camera_ray(stage.scene, sampler);
      const FirstPoint first = first_point(stage.world, ray, true, sampler, stage.counts.camera);
      ASSERT_TRUE(first.point);
      const Scattered s = scatter(stage.world, *first.point, -first.direction, 0, sampler, stage.counts);
      direct.add(first.emission.g + s.direct.g);
      indirect.add(s.indirect.g);
      irradiance.add(s.irradiance.g);
    }
    expect_mean(direct, 1 + a, 0.01);
    expect_mean(indirect, a * a / (1 - a), 0.02);
    expect_mean(irradiance, M_PI * a / (1 - a), 0.02);
  }
}

TEST(Furnace, DepthIsBounded) {
  Stage stage(scenes::room(scenes::emissive(Rgb(0.5f), Rgb(1.0f))));
  for (const int depth : {0, 1, 2, 5}) {
    stage.world.max_depth = depth;
    Estimate total;
    for (int i = 0; i < 20000; ++i) {
      Sampler sampler = test_sampler(3, i);
      const Ray ray = camera_ray(stage.scene, sampler);
      const Scattered s = stage.radiance(ray, sampler);
      if (depth <= 1) {
        EXPECT_TRUE(is_black(s.indirect));
      }
      total.add(s.direct.g + s.indirect.g);
    }
    expect_mean(total, 2 - std::pow(0.5, depth), 0.01);
  }
}

/// A room in which radiance is 1 everywhere: walls and objects emit what they do not reflect.
Scene radiance_one_room() {
  Scene scene = scenes::room(scenes::emissive(Rgb(0.6f), Rgb(0.4f)));
  const int grey = scenes::add(scene, scenes::emissive(Rgb(0.25f), Rgb(0.75f)));
  const int mirror = scenes::add(scene, scenes::metal(Rgb(1.0f), 0));
  const int glass = scenes::add(scene, scenes::glass(1.5f));
  Material sheet = scenes::glass(1.4f);
  sheet.solid = false;
  sheet.double_sided = true;
  const int thin = scenes::add(scene, sheet);
  scene.meshes.push_back(scenes::box({-0.8f, -1, -0.6f}, {-0.4f, -0.2f, -0.2f}, false, grey));
  scene.meshes.push_back(scenes::box({-0.3f, -0.9f, -0.7f}, {0.2f, 0.2f, -0.3f}, false, mirror));
  scene.meshes.push_back(scenes::box({0.3f, -0.5f, -0.4f}, {0.7f, 0.3f, 0}, false, glass));
  scene.meshes.push_back(scenes::quad({-0.6f, 0.3f, 0.1f}, {0.6f, 0, 0}, {0, 0.5f, 0.2f}, thin));
  return scene;
}

TEST(Furnace, RadianceIsOneInAKnownRoom) {
  Stage stage(radiance_one_room());
  Estimate e;
  for (int i = 0; i < 60000; ++i) {
    Sampler sampler = test_sampler(4, i);
    const Ray ray = camera_ray(stage.scene, sampler);
    const Scattered s = stage.radiance(ray, sampler);
    e.add(s.direct.g + s.indirect.g);
  }
  expect_mean(e, 1, 0.005);
}

TEST(Furnace, SpecularObjectsShowRadianceOne) {
  // Mirror, solid glass and sheet alone, so that an error of one cannot hide among the walls.
  Stage stage(radiance_one_room());
  for (const Vec3& target : {Vec3{-0.1f, -0.1f, -0.3f}, Vec3{0.5f, 0, 0}, Vec3{-0.3f, 0.55f, 0.2f}}) {
    const Vec3 eye{0, 0, 0.9f};
    Estimate e;
    for (int i = 0; i < 30000; ++i) {
      Sampler sampler = test_sampler(5, i);
      const Scattered s = stage.radiance({eye, normalize(target - eye)}, sampler);
      e.add(s.direct.g + s.indirect.g);
    }
    expect_mean(e, 1, 0.01);
  }
}

TEST(Furnace, ConvexObjectUnderAUniformSky) {
  // Irradiance pi on every side, all of it indirect, for light samples of the sky are no direct light.
  Scene scene;
  scene.meshes.push_back(scenes::box({-1, -1, -1}, {1, 1, 1}, false, scenes::add(scene, scenes::diffuse(Rgb(0.7f)))));
  scene.environment.radiance = RgbImage(16, 8, Rgb(1.0f));
  Stage stage(scene);
  statistics::Random random(6);
  Estimate indirect, irradiance;
  for (int i = 0; i < 40000; ++i) {
    Sampler sampler = test_sampler(6, i);
    const Vec3 from = uniform_sphere(random.next2()) * 5.0f, wo = normalize(from);
    const Scattered s = scatter(stage.world, stage.hit(from, -wo), wo, 0, sampler, stage.counts);
    EXPECT_TRUE(is_black(s.direct));
    indirect.add(s.indirect.g);
    irradiance.add(s.irradiance.g);
  }
  expect_mean(indirect, 0.7, 0.005);
  expect_mean(irradiance, M_PI, 0.005);
}

TEST(Furnace, GlossySurfaceReflectsItsAlbedoOfTheSky) {
  Scene scene;
  scene.meshes.push_back(
      scenes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, scenes::add(scene, scenes::metal({0.9f, 0.6f, 0.3f}, 0.6f))));
  scene.environment.radiance = RgbImage(16, 8, Rgb(1.0f));
  Stage stage(scene);
  const Vec3 wo = normalize(Vec3{0.7f, 0.5f, 0});
  const SurfacePoint point = stage.hit(wo, -wo);
  Estimate e;
  for (int i = 0; i < 200000; ++i) {
    Sampler sampler = test_sampler(7, i);
    e.add(scatter(stage.world, point, wo, 0, sampler, stage.counts).indirect.g);
  }
  // The table itself is good to 1e-3.
  EXPECT_LT(e.standard_error(), 6e-4);
  EXPECT_NEAR(e.mean(), specular_albedo(point.bsdf, wo.y).g, 1e-3 + 4.5 * e.standard_error());
}

TEST(Leaks, ClosedBoxBesideBrightLightIsExactlyBlack) {
  Scene scene = scenes::room(scenes::diffuse(Rgb(0.9f)));
  for (const Vec3& p : {Vec3{1.2f, 1.2f, 1.2f}, Vec3{-1.001f, 0, 0}, Vec3{0.5f, -1.01f, 0.999f}}) {
    PunctualLight light;
    light.position = p;
    light.intensity = Rgb(1e4f);
    scene.lights.push_back(light);
  }
  scene.environment.radiance = RgbImage(8, 4, Rgb(100.0f));
  Stage stage(scene);
  for (int i = 0; i < 20000; ++i) {
    Sampler sampler = test_sampler(8, i);
    const Ray ray = camera_ray(stage.scene, sampler);
    const Scattered s = stage.radiance(ray, sampler);
    ASSERT_TRUE(is_black(s.direct) && is_black(s.indirect)) << i;
  }
}

}  // namespace
}  // namespace isophote
