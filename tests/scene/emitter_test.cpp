#include "isophote/scene/emitter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/core/error.h"
#include "isophote/sampling/warp.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using Among = Emitters::Among;
using statistics::Random;

/// The triangle that a ray meets first, without an acceleration structure.
std::optional<Hit> nearest(const Scene& scene, const Vec3& from, const Vec3& direction) {
  Hit best;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    for (std::uint32_t t = 0; t < scene.meshes[m].triangles.size(); ++t) {
      const auto& ids = scene.meshes[m].triangles[t];
      const auto& p = scene.meshes[m].positions;
      const Vec3d o(p[ids[0]]), e1 = Vec3d(p[ids[1]]) - o, e2 = Vec3d(p[ids[2]]) - o, d(direction), s = Vec3d(from) - o;
      const double det = dot(e1, cross(d, e2)), u = dot(s, cross(d, e2)) / det, v = dot(d, cross(s, e1)) / det;
      const double distance = dot(e2, cross(s, e1)) / det;
      if (det != 0 && u >= 0 && v >= 0 && u + v <= 1 && distance > 1e-6 && distance < best.distance)
        best = {m, t, static_cast<float>(u), static_cast<float>(v), static_cast<float>(distance)};
    }
  if (best.distance == infinity) return std::nullopt;
  return best;
}

double density(const Scene& scene, const Emitters& emitters, const Vec3& from, const Vec3& d, Among among) {
  const auto hit = nearest(scene, from, d);
  return hit ? emitters.triangle_pdf(*hit, from, d, among) : emitters.environment_pdf(d, among);
}

void expect_sampling_follows_pdf(const Scene& scene, const Vec3& from, Among among) {
  const Emitters emitters(scene);
  int disagree = 0;  // rounding may put a direction into the next texel or triangle
  statistics::expect_density(
      [&](Random& r) -> std::optional<Vec3> {
        const float choice = r.next();
        const LightSample s = emitters.sample(from, choice, r.next2(), among);
        if (!(s.pdf > 0)) return std::nullopt;
        disagree += !(std::abs(s.pdf / density(scene, emitters, from, s.direction, among) - 1) < 1e-3);
        return s.direction;
      },
      [&](const Vec3& d) { return density(scene, emitters, from, d, among); }, 40000, 64);
  EXPECT_LE(disagree, 10);
}

/// Two quads that do not hide each other from the origin, one emitting on both sides.
Scene two_lamps() {
  Scene scene;
  const int warm = scenes::add(scene, scenes::emissive(Rgb(0.0f), {4, 2, 1}));
  Material both = scenes::emissive(Rgb(0.0f), {1, 1, 3});
  both.double_sided = true;
  const int cool = scenes::add(scene, both);
  scene.meshes = {scenes::quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, warm),
                  scenes::quad({1.5f, -1, -1}, {0, 1, 1}, {0.5f, 0, 1}, cool)};
  return scene;
}

/// `two_lamps`, of more triangles than are looked at one by one.
Scene two_lamps_of_many() {
  Scene scene = two_lamps();
  for (Mesh& mesh : scene.meshes) mesh = scenes::divided(mesh, 5);
  return scene;
}

EnvironmentMap sky(bool with_sun) {
  EnvironmentMap map;
  map.radiance = RgbImage(32, 16, Rgb(0.3f));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) map.radiance.at(x, y) = Rgb(0.2f + 0.1f * static_cast<float>((x * 7 + y * 3) % 11));
  if (with_sun) map.radiance.at(20, 4) = {900, 800, 600};
  map.rotation = 0.7f;
  return map;
}

TEST(Emitters, TrianglesAreSampledByTheirPdf) {
  for (const Scene& scene : {two_lamps(), two_lamps_of_many()})
    for (const Vec3& from : {Vec3{0.1f, 0, 0.2f}, Vec3{0.4f, 1.4f, 0.3f}})
      expect_sampling_follows_pdf(scene, from, Among::all);
}

TEST(Emitters, EnvironmentIsSampledByItsPdf) {
  Scene scene;
  scene.environment = sky(false);
  expect_sampling_follows_pdf(scene, {0, 0, 0}, Among::all);
  EXPECT_TRUE(Emitters(scene).empty(Among::sampled_directly));
}

TEST(Emitters, PeaksAndRestTogetherAreSampledByTheirPdf) {
  Scene scene;
  scene.environment = sky(true);
  expect_sampling_follows_pdf(scene, {0, 0, 0}, Among::all);
  expect_sampling_follows_pdf(scene, {0, 0, 0}, Among::sampled_directly);
}

TEST(Emitters, AllKindsTogetherAreSampledByTheirPdf) {
  Scene scene = two_lamps();
  scene.environment = sky(true);
  for (const Among among : {Among::all, Among::sampled_directly}) {
    // An environment sample that a lamp hides counts as lost: the density there is the lamp's.
    const Emitters emitters(scene);
    const Vec3 from{0.1f, 0, 0.2f};
    statistics::Estimate one;
    Random random(8);
    for (int i = 0; i < 100000; ++i) {
      const Vec3 d = uniform_sphere(random.next2());
      one.add((density(scene, emitters, from, d, among)) * 4 * M_PI);
    }
    statistics::Estimate lamp_share;
    for (int i = 0; i < 100000; ++i) {
      const float choice = random.next();
      const LightSample s = emitters.sample(from, choice, random.next2(), among);
      const bool hidden = s.distance == infinity && nearest(scene, from, s.direction);
      lamp_share.add(s.pdf > 0 && !hidden ? 1 : 0);
    }
    statistics::expect_same_mean(one, lamp_share, 0.1);
  }
}

TEST(Emitters, EstimateTheSkysIrradiance) {
  Scene scene;
  scene.environment = sky(true);
  const Emitters emitters(scene);
  // Both strategies see the same sky: light samples and uniform directions.
  statistics::Estimate by_light, by_direction;
  Random random(4);
  for (int i = 0; i < 400000; ++i) {
    const float choice = random.next();
    const LightSample s = emitters.sample({}, choice, random.next2());
    by_light.add(std::max(0.0f, s.direction.y) * s.radiance.g / s.pdf);
    const Vec3 d = uniform_sphere(random.next2());
    by_direction.add(std::max(0.0f, d.y) * emitters.environment(d).radiance.g * 4 * M_PI);
    EXPECT_EQ(s.sampled_directly, emitters.environment(s.direction).sampled_directly);
  }
  statistics::expect_same_mean(by_light, by_direction, 0.05);
}

TEST(Emitters, SunIsAPeakAndUniformSkyHasNone) {
  Scene scene;
  scene.environment = sky(true);
  const Emitters emitters(scene);
  int peaks = 0;
  Random random(6);
  for (int i = 0; i < 20000; ++i) peaks += emitters.environment(uniform_sphere(random.next2())).sampled_directly;
  EXPECT_GT(peaks, 0);
  EXPECT_LT(peaks, 20000 / 32);
  scene.environment.radiance = RgbImage(32, 16, Rgb(5.0f));
  EXPECT_TRUE(Emitters(scene).empty(Among::sampled_directly));
}

TEST(Emitters, EnvironmentIsOrientedAsDocumented) {
  Scene scene;
  scene.environment.radiance = RgbImage(8, 4, Rgb(0.0f));
  RgbImage& image = scene.environment.radiance;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) image.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0};
  const auto look = [&](const Vec3& d) { return Emitters(scene).environment(normalize(d)).radiance; };
  EXPECT_NEAR(look({0, 0, -1}).r, 3.5f, 1e-4);   // the middle
  EXPECT_NEAR(look({1, 0, 0}).r, 5.5f, 1e-4);    // to the right of it
  EXPECT_NEAR(look({0.001f, 1, 0}).g, 0, 1e-4);  // the top row
  EXPECT_NEAR(look({0.001f, -1, 0}).g, 3, 1e-4);
  scene.environment.rotation = pi / 2;  // counter-clockwise from above: -Z goes to -X
  EXPECT_NEAR(look({-1, 0, 0}).r, 3.5f, 1e-4);
}

TEST(Emitters, ManyAreChosenByPowerAndATenthAlike) {
  const Scene scene = two_lamps_of_many();
  const Emitters emitters(scene);
  // pi L A, twice for two sides; the parallelogram's area is |(0,1,1) x (1/2,0,1)| = sqrt(1 + 1/4 + 1/4).
  const double warm = 4 * luminance(Rgbd{4, 2, 1}), cool = 2 * std::sqrt(1.5) * luminance(Rgbd{1, 1, 3});
  int count = 0;
  constexpr int draws = 1 << 16;
  for (int i = 0; i < draws; ++i)
    count += emitters.sample({}, static_cast<float>(i) / draws, {0.3f, 0.6f}).direction.y > 0.5f;
  EXPECT_NEAR(count / double(draws), 0.05 + 0.9 * warm / (warm + cool), 1e-4);
}

TEST(Emitters, TheWeakestIsNotForgottenBesideTheStrongest) {
  Scene scene = two_lamps();
  scene.materials[0].emission = Rgb(1e9f);
  const Emitters emitters(scene);
  int found = 0;
  constexpr int draws = 1 << 12;
  for (int i = 0; i < draws; ++i)
    found += emitters.sample({}, static_cast<float>(i) / draws, {0.3f, 0.6f}).direction.y < 0.5f;
  EXPECT_NEAR(found / double(draws), 0.1 / 2, 1e-3);  // two of four triangles
}

TEST(Emitters, TexturedLampIsChosenByItsMeanAndExactAtThePoint) {
  Scene scene = two_lamps();
  Texture texture;  // left half black
  texture.width = 64, texture.height = 1;
  for (int x = 0; x < 64; ++x)
    for (const int c : {0, 0, 0, 255}) texture.rgba.push_back(static_cast<std::uint8_t>(c == 255 || x >= 32 ? 255 : 0));
  scene.textures.push_back(texture);
  scene.materials[0].emission_texture.texture = 0;
  const Emitters emitters(scene);
  statistics::Estimate estimate;
  Random random(9);
  double truth = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      // Irradiance on an upward plane at the origin, of the bright half of the quad at y = 2.
      const double x = -1 + 2 * (i + 0.5) / n, z = -1 + 2 * (j + 0.5) / n, d2 = x * x + 4 + z * z;
      // uv: u runs along x; black until the texel boundary at x = 0, linear over one texel of 1/32.
      const double value = std::clamp(((x + 1) / 2 * 64 - 31.5), 0.0, 1.0) +
                           (x > 1 - 1.0 / 64 ? -((x + 1) / 2 * 64 - 63.5) : 0) +
                           (x < -1 + 1.0 / 64 ? 0.5 - (x + 1) / 2 * 64 : 0);
      truth += 4 * value * 4 / (d2 * d2) * (2.0 / n) * (2.0 / n);
    }
  for (int i = 0; i < 200000; ++i) {
    const float choice = random.next();
    const LightSample s = emitters.sample({}, choice, random.next2());
    const bool warm = s.pdf > 0 && s.radiance.b < s.radiance.r;
    estimate.add(warm ? s.radiance.r * s.direction.y / s.pdf : 0);
  }
  statistics::expect_mean(estimate, truth, 0.01);
}

TEST(Emitters, BlendedLampShinesByItsCoverage) {
  Scene scene = two_lamps();
  scene.materials[0].alpha = Alpha::blend;
  scene.materials[0].base_alpha = 0.25f;
  const LightSample s = Emitters(scene).sample({}, 0, {0.3f, 0.6f});
  EXPECT_FLOAT_EQ(s.radiance.r, 1);
}

TEST(Emitters, PeaksAreOneEmitterHoweverMany) {
  // Bright caps at both poles, 1/40 of the sphere, have more texels than there may be triangles.
  Scene scene = two_lamps();
  const int width = 4096, height = 2048;
  scene.environment.radiance = RgbImage(width, height, Rgb(0.0f));
  for (int y = 0; y < height; ++y)
    if (std::abs(std::cos(pi * (static_cast<float>(y) + 0.5f) / height)) > 1 - 1 / 40.0f)
      for (int x = 0; x < width; ++x) scene.environment.radiance.at(x, y) = Rgb(1.0f);
  const Emitters emitters(scene);
  std::size_t peaks = 0;
  for (const Rgb& pixel : scene.environment.radiance.pixels) peaks += pixel.g > 0;
  EXPECT_GT(peaks, Emitters::most);
  EXPECT_TRUE(emitters.environment({0, 1, 0}).sampled_directly);
  for (const Among among : {Among::all, Among::sampled_directly}) {
    int sky = 0;
    constexpr int draws = 1 << 12;
    for (int i = 0; i < draws; ++i) {
      const LightSample s = emitters.sample({}, static_cast<float>(i) / draws, {0.3f, 0.6f}, among);
      sky += s.distance == infinity;
      if (s.distance == infinity) {
        EXPECT_NEAR(s.pdf / emitters.environment_pdf(s.direction, among), 1, 1e-3);
      }
    }
    EXPECT_GT(sky, draws / 50);  // a tenth goes to four triangles and the peaks alike
  }
}

TEST(Emitters, TooManyTrianglesAreRefused) {
  Scene scene = two_lamps();
  scene.meshes[0].triangles.resize(Emitters::most, scene.meshes[0].triangles[0]);
  try {
    Emitters{scene};
    ADD_FAILURE() << "not refused";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(Emitters::most)), std::string::npos);
  }
  scene.meshes[0].triangles.resize(Emitters::most - 2);
  scene.environment = sky(false);
  const Emitters emitters(scene);
  for (const Among among : {Among::all, Among::sampled_directly}) {
    int forgotten = 0;
    const Hit at{0, 0, 0.3f, 0.3f};
    for (std::uint32_t t = 0; t < Emitters::most - 2; ++t)
      forgotten += !(emitters.triangle_pdf({0, t, at.u, at.v}, {}, {0, 1, 0}, among) > 0);
    EXPECT_EQ(forgotten, 0);
  }
}

TEST(Emitters, EmptyWithoutLight) {
  Scene scene = scenes::room(scenes::diffuse(Rgb(0.5f)));
  EXPECT_TRUE(Emitters(scene).empty());
  EXPECT_TRUE(Emitters(Scene{}).empty());
}

}  // namespace
}  // namespace isophote
