#include <gtest/gtest.h>

#include <vector>

#include "render.h"
#include "support/scenes.h"

namespace isophote {
namespace {

/// A box with every kind of light and surface in it, `s` times as large.
Scene everything(float s) {
  Scene scene = scenes::cornell_box(s);
  Material plastic = scenes::diffuse({0.2f, 0.4f, 0.7f});
  plastic.specular = 1;
  plastic.roughness = 0.3f;
  Material glass = scenes::glass(1.5f);
  glass.attenuation_color = {0.9f, 0.5f, 0.7f};
  glass.attenuation_distance = 0.3f * s;
  Material veil = scenes::diffuse(Rgb(0.8f));
  veil.alpha = Alpha::blend;
  veil.base_alpha = 0.4f;
  const Vec3 a{-0.9f, 0.1f, 0.2f}, b{-0.5f, 0.6f, 0.7f}, c{0.4f, 0.9f, 0.1f}, d{0.8f, 1.3f, 0.5f};
  scene.meshes.push_back(scenes::box(a * s, b * s, false, scenes::add(scene, glass)));
  scene.meshes.push_back(scenes::box(c * s, d * s, false, scenes::add(scene, plastic)));
  scene.meshes.push_back(
      scenes::quad(Vec3{-0.5f, 1.2f, 0.6f} * s, Vec3{1, 0, 0.1f} * s, Vec3{0, 0.5f, 0} * s, scenes::add(scene, veil)));
  scene.meshes.push_back(scenes::quad(Vec3{-0.9f, 1.1f, -0.9f} * s, Vec3{1, 0, 0.1f} * s, Vec3{0, 0.5f, 0.3f} * s,
                                      scenes::add(scene, scenes::metal(Rgb(0.9f), 0))));
  PunctualLight point, spot, sun;
  point.position = Vec3{0.5f, 1.7f, 0.4f} * s;
  point.intensity = Rgb(0.7f) * (s * s);
  spot.kind = PunctualLight::Kind::spot;
  spot.position = Vec3{-0.7f, 1.8f, 0.7f} * s;
  spot.direction = normalize(Vec3{0.3f, -1, -0.2f});
  spot.intensity = Rgb(1.0f) * (s * s);
  spot.range = 3 * s;
  sun.kind = PunctualLight::Kind::directional;
  sun.direction = normalize(Vec3{0.1f, -0.3f, -1});
  scene.lights = {point, spot, sun};
  scene.environment.radiance = RgbImage(16, 8, Rgb(0.3f));
  scene.environment.radiance.at(6, 3) = Rgb(80.0f);
  return scene;
}

std::vector<Rgb> render(float s) {
  const FlushDenormals flush;
  Stage stage(everything(s));
  std::vector<Rgb> values;
  constexpr int size = 48;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int k = 0; k < 2; ++k) {
        Sampler sampler(Purpose::test, 1, static_cast<std::uint64_t>(y * size + x), static_cast<std::uint32_t>(k));
        const Vec2 u = sampler.next2();
        const Ray ray =
            stage.scene.cameras[0].ray(static_cast<float>(x) + u.x, static_cast<float>(y) + u.y, size, size);
        const FirstPoint first = first_point(stage.world, ray, true, sampler, stage.counts.camera);
        values.push_back(first.emission);
        if (!first.point) continue;
        const Vec3 wo = -first.direction;
        const Scattered scattered = scatter(stage.world, *first.point, wo, first.depth, sampler, stage.counts);
        for (const Rgb& v : {scattered.direct, scattered.indirect, scattered.irradiance}) values.push_back(v);
        values.push_back(direct_light(stage.world, *first.point, wo, false, sampler, stage.counts));
        const GlossyRay glossy = glossy_ray(stage.world, *first.point, wo, sampler, stage.counts);
        for (const Rgb& v : {glossy.direct, glossy.weight, glossy.next.emission, glossy.next.throughput})
          values.push_back(v);
      }
  return values;
}

TEST(Scale, PowersOfTwoChangeNothing) {
  const std::vector<Rgb> one = render(1);
  std::size_t lit = 0;
  for (const Rgb& v : one) {
    ASSERT_TRUE(is_finite(v));
    lit += !is_black(v);
  }
  EXPECT_GT(lit, 10000u);
  for (const float s : {0x1p-10f, 0x1p13f}) {
    const std::vector<Rgb> scaled = render(s);
    ASSERT_EQ(scaled.size(), one.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < one.size(); ++i) different += scaled[i] != one[i];
    EXPECT_EQ(different, 0u) << s;
  }
}

}  // namespace
}  // namespace isophote
