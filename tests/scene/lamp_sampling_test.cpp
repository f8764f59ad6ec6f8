#include "isophote/scene/lamp_sampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/core/frame.h"
#include "isophote/sampling/warp.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using Among = Emitters::Among;
using statistics::Random;

struct Samples {
  double mean, deviation;
};

/// Irradiance, as single light samples tell it, of a surface at a point with a normal.
Samples irradiance(const Scene& scene, const Vec3& from, const Vec3& normal) {
  const Emitters emitters(scene);
  statistics::Estimate irradiance;
  Random random(12);
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const float choice = random.next();
    const LightSample s = emitters.sample(from, choice, random.next2());
    irradiance.add(s.pdf > 0 ? s.radiance.r * std::max(0.0f, dot(s.direction, normal)) / s.pdf : 0);
  }
  return {irradiance.mean(), irradiance.standard_error() * std::sqrt(static_cast<double>(draws))};
}

TEST(LampSampling, NearALongStripSamplesDifferByTheirCosines) {
  for (const float width : {0.1f, 0.005f}) {
    Scene scene;
    scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(2.0f)));
    scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(0.001f * width)));
    scene.meshes = {scenes::quad({-10, 1, 0}, {20, 0, 0}, {0, 0, width}, 0),
                    scenes::quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1)};
    for (const float x : {-9.0f, 0.0f, 4.0f}) {
      const Samples e = irradiance(scene, {x, 0, 0}, {0, 1, 0});
      EXPECT_LT(e.deviation, 0.5 * e.mean) << x << ' ' << width;
    }
  }
}

TEST(LampSampling, IsExactFromTheLampItselfToFarAway) {
  // Irradiance is radiance times the solid angle times the cosine, where that is small; pi where it is a half space.
  Scene scene;
  scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1.0f)));
  scene.meshes = {scenes::quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0)};
  const Samples close = irradiance(scene, {0.1f, -1e-5f, 0.2f}, {0, 1, 0});
  EXPECT_NEAR(close.mean, M_PI, 0.1);
  EXPECT_LT(close.deviation, close.mean);
  for (const float distance : {1e2f, 1e4f, 1e7f}) {
    const Samples far = irradiance(scene, {0.3f * distance, -distance, 0.1f * distance}, {0, 1, 0});
    const double exact = 1 / std::pow(distance * std::sqrt(1 + 0.09 + 0.01), 2) / (1 + 0.09 + 0.01);
    EXPECT_NEAR(far.mean / exact, 1, 0.02) << distance;
  }
}

TEST(LampSampling, OnesOwnPlaneTakesNoSamples) {
  // A glowing box, turned so that points of a side are on either side of its plane, by rounding.
  const Frame turn(normalize(Vec3{0.3f, 0.5f, 0.8f}));
  Scene scene = scenes::room(scenes::emissive(Rgb(0.0f), Rgb(1.0f)));
  for (Mesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) p = turn.to_world(p);
  const Emitters emitters(scene);
  int points = 0, own = 0;
  constexpr int draws = 200;
  for (const Mesh& mesh : scene.meshes)
    for (const auto& ids : mesh.triangles) {
      const Vec3 &a = mesh.positions[ids[0]], ab = mesh.positions[ids[1]] - a, ac = mesh.positions[ids[2]] - a;
      const Vec3 normal = normalize(cross(ab, ac));
      Random random(5);
      for (int i = 0; i < draws; ++i, ++points) {
        const Vec2 b = uniform_triangle(random.next2());
        const float choice = random.next();
        const LightSample s = emitters.sample(a + ab * b.x + ac * b.y, choice, random.next2());
        own += s.pdf > 0 && std::abs(dot(s.direction, normal)) < 1e-3f;
      }
    }
  EXPECT_LT(own, points / 100);
}

TEST(Emitters, NearIsConservative) {
  // Wherever a cosine-distributed ray could meet a lamp with four times the density of light sampling, near() holds.
  Scene scene = scenes::cornell_box();
  for (Mesh& mesh : scene.meshes)
    if (!is_black(scene.materials[mesh.material].emission)) mesh = scenes::divided(mesh, 5);
  const Emitters emitters(scene);
  Random random(3);
  int near = 0, needed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 from{2 * random.next() - 1, 2 * random.next(), 2 * random.next() - 1};
    bool needs = false;
    for (int k = 0; k < 16; ++k) {
      const LightSample s = emitters.sample(from, random.next(), random.next2(), Among::sampled_directly);
      needs |= s.pdf > 0 && 1 / pi > 4 * s.pdf;
    }
    needed += needs;
    near += emitters.near(from);
    EXPECT_TRUE(!needs || emitters.near(from));
  }
  EXPECT_GT(needed, 0);
  EXPECT_LT(near, 20000 / 5);
}

}  // namespace
}  // namespace isophote
