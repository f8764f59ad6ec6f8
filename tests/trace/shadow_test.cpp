#include "isophote/trace/shadow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/sampling/warp.h"
#include "render.h"
#include "support/scenes.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

constexpr float floor_albedo = 0.5f;

/// A floor, 10 x 10 about the origin.
Scene floor_scene() {
  Scene scene;
  const int grey = scenes::add(scene, scenes::diffuse(Rgb(floor_albedo)));
  scene.meshes.push_back(scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, grey));
  return scene;
}

/// A horizontal square, facing up, or down if its sides are swapped.
Mesh level(float height, float half, int material, bool down = false) {
  const Vec3 x{2 * half, 0, 0}, z{0, 0, 2 * half};
  return scenes::quad({-half, height, -half}, down ? x : z, down ? z : x, material);
}

void add_lamp(Scene& scene, float height, float half, const Rgb& radiance) {
  scene.meshes.push_back(level(height, half, scenes::add(scene, scenes::emissive(Rgb(0.0f), radiance)), true));
}

PunctualLight point_light(const Vec3& position, float intensity) {
  PunctualLight light;
  light.position = position;
  light.intensity = Rgb(intensity);
  return light;
}

Material pane() {
  Material sheet = scenes::glass(1.5f);
  sheet.solid = false;
  sheet.base_color = {0.9f, 0.8f, 0.5f};
  return sheet;
}

/// Direct and all light scattered up from the floor under (0, 1, 0).
struct FromFloor {
  Estimate direct, all;

  FromFloor(Stage& stage, int samples, const Vec3& at = {0, 1e-3f, 0}) {
    const SurfacePoint point = stage.hit(at, {0, -1, 0});
    for (int i = 0; i < samples; ++i) {
      Sampler sampler = test_sampler(1, i);
      const Scattered s = scatter(stage.world, point, {0, 1, 0}, 0, sampler, stage.counts);
      direct.add(s.direct.g);
      all.add(s.direct.g + s.indirect.g);
    }
  }
};

/// Share of unpolarized light that one smooth interface reflects.
double fresnel(double cosine, double eta) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * inside) / (cosine + eta * inside);
  const double p = (eta * cosine - inside) / (eta * cosine + inside);
  return (s * s + p * p) / 2;
}

TEST(Shadow, OfAPlateJustBeforeALamp) {
  Scene scene = floor_scene();
  add_lamp(scene, 8, 1, Rgb(3.0f));
  scene.meshes.push_back(level(7.999f, 1.5f, scenes::add(scene, scenes::diffuse(Rgb(0.0f)))));
  Stage stage(scene);
  EXPECT_EQ(FromFloor(stage, 2000).all.mean(), 0);
}

TEST(Shadow, ACoverOfGlassLeavesALampToThePathsThroughIt) {
  Scene scene = floor_scene();
  add_lamp(scene, 2, 2, Rgb(3.0f));
  Material clear = scenes::glass(1.5f);
  clear.solid = false;
  clear.specular = 0;  // all passes, nothing is reflected
  scene.meshes.push_back(level(1.9997f, 2.5f, scenes::add(scene, clear)));
  Stage stage(scene);
  const FromFloor seen(stage, 40000);
  EXPECT_EQ(seen.direct.mean(), 0);
  // Four times the form factor of a rectangle under its corner: 2 / pi * (x / s * atan(x / s)), x = 1, s^2 = 2.
  const double form_factor = 4 / M_PI * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
  expect_mean(seen.all, floor_albedo * 3 * form_factor, 0.01);
}

TEST(Shadow, ALampDoesNotHideItself) {
  // Turned anyhow, far from the world's origin, of every size; narrow too, where normals are rounded.
  statistics::Random random(1);
  for (const float narrow : {1.0f, 300.0f})
    for (int i = 0; i < 6; ++i) {
      const Frame frame(uniform_sphere(random.next2()));
      const Vec3 centre = uniform_sphere(random.next2()) * (i % 2 ? 50.0f : 1.0f);
      const float size = std::exp2(6 * random.next() - 4);
      Scene scene;
      const int lamp = scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1.0f)));
      scene.meshes.push_back(
          scenes::quad(centre, frame.to_world({size, 0, 0}), frame.to_world({0, size / narrow, 0}), lamp));
      Stage stage(scene);
      for (int k = 0; k < 500; ++k) {
        SurfacePoint point;
        point.geometric_normal = -frame.to_world(cosine_hemisphere(random.next2()));
        point.position = centre - point.geometric_normal * (5 * random.next() + size);
        const LightSample light = stage.emitters.sample(point.position, random.next(), random.next2());
        if (light.pdf > 0) {
          EXPECT_EQ(light_transmittance(stage.world, ShadowStart(point, light.direction), light, 0, stage.counts),
                    Rgb(1.0f));
        }
      }
    }
}

/// Turned anyhow and narrow: rounding of the normal counts there. Of the narrowest triangles it is not all made up for,
/// or their rays would pass over what lies near.
TEST(Shadow, NoTriangleMeetsRaysThatLeaveIt) {
  statistics::Random random(2);
  for (const float narrow : {1.0f, 30.0f, 1000.0f, 10000.0f}) {
    int met = 0;
    for (int i = 0; i < 10; ++i) {
      const Frame frame(uniform_sphere(random.next2()));
      Scene scene;
      Mesh mesh = scenes::quad(uniform_sphere(random.next2()), frame.to_world({1, 0, 0}),
                               frame.to_world({random.next(), 1 / narrow, 0}), scenes::add(scene, Material{}));
      mesh.triangles.pop_back();
      scene.meshes.push_back(mesh);
      const RayCaster rays(scene);
      for (int k = 0; k < 200; ++k) {
        const Vec2 at = uniform_triangle(random.next2());
        const SurfacePoint point = surface_point(scene, {{}, frame.n}, {0, 0, at.x, at.y, 1});
        const Vec3 any = uniform_sphere(random.next2());
        const Vec3 direction = normalize(any - frame.n * (0.99f * dot(any, frame.n)));  // most are grazing
        met += rays.occluded({offset_origin(point, direction), direction}, 0);
        EXPECT_LT(point.offset, std::max(2e-5f, 0.3f / narrow));
      }
    }
    EXPECT_LE(met, narrow > 1000 ? 100 : 0) << narrow;  // of 2000 rays, nearly all grazing
  }
}

TEST(Shadow, OfAThinPlateIsThereWhateverElseIsInTheScene) {
  // A plate 1 cm over the floor, a light over it, and one triangle far away.
  Scene scene = floor_scene();
  const int black = scenes::add(scene, scenes::diffuse(Rgb(0.0f)));
  scene.meshes.push_back(level(0.01f, 0.5f, black));
  scene.meshes.push_back(scenes::quad({0, 0, -1e5f}, {1, 0, 0}, {0, 1, 0}, black));
  scene.lights.push_back(point_light({0, 2, 0}, 1));
  Stage stage(scene);
  EXPECT_EQ(FromFloor(stage, 1).all.mean(), 0);
  EXPECT_GT(FromFloor(stage, 1, {0.6f, 1e-3f, 0}).all.mean(), 0);
}

TEST(Shadow, PunctualLightComesThroughPanes) {
  Scene scene = floor_scene();
  const int glass = scenes::add(scene, pane());
  scene.meshes.push_back(level(1, 4, glass));
  scene.lights.push_back(point_light({3, 4, 0}, 50));
  const double through = 0.8 * (1 - fresnel(0.8, 1.5)), bare = floor_albedo / M_PI * 50 / 25 * 0.8;
  const auto direct = [](const Scene& s) {
    Stage stage(s);
    const SurfacePoint point = stage.hit({0, 1e-3f, 0}, {0, -1, 0});
    Sampler sampler = test_sampler(1, 0);
    const float value = scatter(stage.world, point, {0, 1, 0}, 0, sampler, stage.counts).direct.g;
    EXPECT_NEAR(direct_light(stage.world, point, {0, 1, 0}, false, sampler, stage.counts).g, value, 1e-5f * value);
    return value;
  };
  EXPECT_NEAR(direct(scene), bare * through, 1e-5 * bare);
  scene.meshes.push_back(level(2, 4, glass));
  EXPECT_NEAR(direct(scene), bare * through * through, 1e-5 * bare);
  scene.meshes.push_back(level(5, 4, 0));  // behind the light
  EXPECT_NEAR(direct(scene), bare * through * through, 1e-5 * bare);
  Scene sun = scene;
  sun.meshes.pop_back();
  sun.lights[0].kind = PunctualLight::Kind::directional;
  sun.lights[0].direction = {0, -1, 0};
  EXPECT_NEAR(direct(sun), floor_albedo / M_PI * 50 * std::pow(0.8 * 0.96, 2), 1e-5 * 50);
  Scene plate = scene;
  plate.meshes.push_back(level(3, 4, 0));
  EXPECT_EQ(direct(plate), 0);
  scene.materials[glass].solid = true;  // what refracts, casts a shadow
  EXPECT_EQ(direct(scene), 0);
}

/// A cube of absorbing glass about (0, 0, 0), 4 wide, a floor and a lamp inside.
Scene inside_glass() {
  Scene scene;
  Material glass = scenes::glass(1.0f);
  glass.specular = 0;
  glass.attenuation_color = Rgb(0.5f);
  glass.attenuation_distance = 1;
  scene.meshes.push_back(scenes::box({-2, -2, -2}, {2, 2, 2}, false, scenes::add(scene, glass)));
  const int grey = scenes::add(scene, scenes::diffuse(Rgb(floor_albedo)));
  scene.meshes.push_back(level(-1, 1, grey));
  return scene;
}

/// The point (0, -1, 0) of that floor, as a camera outside sees it.
FirstPoint seen_inside(Stage& stage) {
  Sampler sampler = test_sampler(9, 0);
  const FirstPoint first = first_point(stage.world, {{0, 5, 0}, {0, -1, 0}}, false, sampler, stage.counts.camera);
  EXPECT_TRUE(first.point);
  EXPECT_NEAR(first.throughput.g, std::pow(0.5, 3), 1e-5);
  return first;
}

TEST(Absorption, DimsLightBetweenTwoPointsInside) {
  Scene scene = inside_glass();
  scene.lights.push_back(point_light({0, 0.5f, 0}, 3));
  Stage stage(scene);
  const FirstPoint first = seen_inside(stage);
  Sampler sampler = test_sampler(1, 0);
  const double e = 3 / (1.5 * 1.5) * std::pow(0.5, 1.5);
  EXPECT_NEAR(scatter(stage.world, *first.point, {0, 1, 0}, 0, sampler, stage.counts).direct.g, floor_albedo / M_PI * e,
              1e-5);
}

TEST(Absorption, DimsALampInsideForEveryTechnique) {
  // A lamp so low and wide, and of so many triangles, that all ways of sampling have their share.
  Scene scene = inside_glass();
  const float height = 0.05f;
  add_lamp(scene, -1 + height, 1, Rgb(3.0f));
  scene.meshes.back() = scenes::divided(scene.meshes.back(), 5);
  Stage stage(scene);
  SurfacePoint point = stage.hit({0, -1 + height / 2, 0}, {0, -1, 0});
  EXPECT_TRUE(is_black(point.medium));
  EXPECT_TRUE(stage.emitters.near(point.position));
  point.medium = stage.hit({0, 0, 0}, {0, 1, 0}).medium;
  EXPECT_NEAR(point.medium.g, std::log(2.0), 1e-6);
  // 2 integral of cos sin 2^(-height / cos), over a lamp that is nearly the whole sky: what it leaves out is 1e-2.5.
  double absorbed = 0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double c2 = (i + 0.5) / steps;  // of cos^2
    const double radius = height * std::sqrt(1 / c2 - 1);
    // The share of azimuths in which a square of half width 1 reaches that far.
    const double share = radius <= 1 ? 1 : radius >= std::sqrt(2) ? 0 : 1 - 4 / M_PI * std::acos(1 / radius);
    absorbed += share * std::pow(0.5, height / std::sqrt(c2)) / steps;
  }
  Estimate all, diffuse;
  for (int i = 0; i < 40000; ++i) {
    Sampler a = test_sampler(1, i), b = test_sampler(2, i);
    all.add(scatter(stage.world, point, {0, 1, 0}, 0, a, stage.counts).direct.g);
    diffuse.add(direct_light(stage.world, point, {0, 1, 0}, false, b, stage.counts).g);
  }
  expect_mean(all, floor_albedo * 3 * absorbed, 0.01);
  expect_mean(diffuse, floor_albedo * 3 * absorbed, 0.01);
}

TEST(Absorption, IsCarriedAlongPathsInside) {
  // What a ray from the floor meets inside knows the medium that it came through.
  Stage stage(inside_glass());
  const SurfacePoint point = *seen_inside(stage).point;
  EXPECT_NEAR(point.medium.g, std::log(2.0), 1e-6);
  Sampler sampler = test_sampler(2, 0);
  const Ray across{{0, -1.5f, 0}, {0, 1, 0}};  // to the floor's other side
  const FirstPoint met = first_point(stage.world, across, false, sampler, stage.counts.camera, point.medium);
  EXPECT_NEAR(met.throughput.g, std::pow(0.5, 0.5), 1e-6);
  ASSERT_TRUE(met.point);
  EXPECT_EQ(met.point->medium, point.medium);
  const Ray out{{0, 0, 0}, {0, 1, 0}};
  EXPECT_NEAR(first_point(stage.world, out, false, sampler, stage.counts.camera, point.medium).throughput.g, 0.25,
              1e-6);
}

}  // namespace
}  // namespace isophote
