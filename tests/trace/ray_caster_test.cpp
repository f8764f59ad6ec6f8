#include "isophote/trace/ray_caster.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>

#include "isophote/sampling/warp.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

Scene square(const Material& material) {
  Scene scene;
  scene.meshes.push_back(scenes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, scenes::add(scene, material)));
  return scene;
}

TEST(RayCaster, MeetsTheNearestTriangle) {
  Scene scene = square(scenes::diffuse(Rgb(0.5f)));
  scene.meshes.push_back({});  // empty meshes keep their ids
  scene.meshes.push_back(scenes::quad({0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 0));
  const RayCaster rays(scene);
  const Ray ray{{0.75f, 0.5f, 2}, {0, 0, -1}};
  Hit hit;
  ASSERT_TRUE(rays.intersect(ray, 0, hit));
  EXPECT_EQ(hit.mesh, 0u);
  EXPECT_EQ(hit.triangle, 0u);
  EXPECT_FLOAT_EQ(hit.distance, 2);
  EXPECT_FLOAT_EQ(hit.u, 0.25f);  // of corner (1, 0)
  EXPECT_FLOAT_EQ(hit.v, 0.5f);   // of corner (1, 1)
  ASSERT_TRUE(rays.intersect({ray.origin, ray.direction, 2.5f}, 0, hit));
  EXPECT_EQ(hit.mesh, 2u);
  EXPECT_FALSE(rays.intersect({ray.origin, ray.direction, 0, 1.9f}, 0, hit));
  EXPECT_FALSE(rays.occluded({ray.origin, ray.direction, 0, 1.9f}, 0));
  EXPECT_TRUE(rays.occluded({ray.origin, ray.direction, 0, 2.1f}, 0));
  EXPECT_FALSE(rays.occluded({ray.origin, {0, 0, 1}}, 0));
  EXPECT_FLOAT_EQ(rays.scene_scale(), std::sqrt(3.0f));
}

TEST(RayCaster, AgreesWithBruteForce) {
  Scene scene;
  Random random(1);
  Mesh soup;
  soup.material = scenes::add(scene, scenes::diffuse(Rgb(0.5f)));
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec3 c{random.next(), random.next(), random.next()};
    for (int k = 0; k < 3; ++k) soup.positions.push_back(c + uniform_sphere(random.next2()) * 0.15f);
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  scene.meshes.push_back(soup);
  const RayCaster rays(scene);
  int hits = 0, disagree = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{{random.next(), random.next(), random.next()}, uniform_sphere(random.next2())};
    double nearest = infinity;
    std::uint32_t which = 0;
    for (std::uint32_t t = 0; t < 200; ++t) {
      const Vec3d o(soup.positions[3 * t]), e1 = Vec3d(soup.positions[3 * t + 1]) - o,
                                            e2 = Vec3d(soup.positions[3 * t + 2]) - o;
      const Vec3d d(ray.direction), s = Vec3d(ray.origin) - o;
      const double det = dot(e1, cross(d, e2)), u = dot(s, cross(d, e2)) / det, v = dot(d, cross(s, e1)) / det;
      const double distance = dot(e2, cross(s, e1)) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < nearest) nearest = distance, which = t;
    }
    Hit hit;
    const bool met = rays.intersect(ray, 0, hit);
    EXPECT_EQ(met, rays.occluded(ray, 0));
    hits += met;
    disagree +=
        met != (nearest < infinity) || (met && (hit.triangle != which || std::abs(hit.distance - nearest) > 1e-5));
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LE(disagree, 2);  // at edges, by rounding
}

TEST(RayCaster, EmptySceneIsAllSky) {
  const Scene scene;
  const RayCaster rays(scene);
  Hit hit;
  EXPECT_FALSE(rays.intersect({{0, 0, 0}, {0, 0, 1}}, 0, hit));
  EXPECT_FALSE(rays.occluded({{0, 0, 0}, {0, 0, 1}}, 0));
}

TEST(RayCaster, MasksLetRaysThroughWhereTransparent) {
  Material material = scenes::diffuse(Rgb(1.0f));
  material.alpha = Alpha::mask;
  material.base_color_texture.texture = 0;
  Scene scene = square(material);
  Texture texture;  // left half transparent
  texture.width = 2, texture.height = 1;
  texture.rgba = {255, 255, 255, 0, 255, 255, 255, 255};
  texture.wrap_u = Wrap::clamp;
  scene.textures.push_back(texture);
  const RayCaster rays(scene);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const float x = random.next();
    if (std::abs(x - 0.5f) < 1e-3f) continue;
    const Ray ray{{x, random.next(), 1}, {0, 0, -1}};
    Hit hit;
    EXPECT_EQ(rays.intersect(ray, static_cast<std::uint32_t>(i), hit), x > 0.5f);
    EXPECT_EQ(rays.occluded(ray, static_cast<std::uint32_t>(i)), x > 0.5f);
  }
}

TEST(RayCaster, BlendingCoversByChance) {
  Material material = scenes::diffuse(Rgb(1.0f));
  material.alpha = Alpha::blend;
  material.base_alpha = 0.3f;
  const Scene scene = square(material);
  const RayCaster rays(scene);
  Random random(3);
  constexpr int draws = 40000;
  int over_places = 0, over_seeds = 0;
  for (int i = 0; i < draws; ++i) {
    const Ray ray{{random.next(), random.next(), 1}, {0, 0, -1}}, fixed{{0.3f, 0.6f, 1}, {0, 0, -1}};
    const auto seed = static_cast<std::uint32_t>(i);
    Hit hit;
    const bool met = rays.intersect(ray, 5, hit);
    EXPECT_EQ(met, rays.occluded(ray, 5));  // one decision for both kinds of ray, and for ever
    over_places += met;
    over_seeds += rays.occluded(fixed, seed);
  }
  const double deviation = std::sqrt(draws * 0.3 * 0.7);
  EXPECT_NEAR(over_places, 0.3 * draws, 4.5 * deviation);
  EXPECT_NEAR(over_seeds, 0.3 * draws, 4.5 * deviation);
}

TEST(FlushDenormals, LivesWithItsScope) {
  const unsigned before = _mm_getcsr();
  volatile float tiny = 1e-30f;
  {
    const FlushDenormals flush;
    EXPECT_EQ(tiny * 1e-10f, 0);
    const FlushDenormals nested;
  }
  EXPECT_EQ(_mm_getcsr() & 0x8040u, before & 0x8040u);
  EXPECT_NE(tiny * 1e-10f, 0);
}

}  // namespace
}  // namespace isophote
