#include <gtest/gtest.h>

#include <vector>

#include "render.h"
#include "support/media.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

const Box cube{{-1, -1, -1}, {1, 1, 1}};

Ray camera_ray(const Scene& scene, Sampler& sampler) {
  const Vec2 u = sampler.next2();
  return scene.cameras[0].ray(u.x * 64, u.y * 64, 64, 64);
}

Estimate mean_radiance(Stage& stage, int samples, std::uint64_t seed, std::optional<Ray> ray = {}) {
  Estimate e;
  for (int i = 0; i < samples; ++i) {
    Sampler sampler = test_sampler(seed, i);
    const Scattered s = stage.radiance(ray ? *ray : camera_ray(stage.scene, sampler), sampler);
    e.add(s.direct.g + s.indirect.g);
  }
  return e;
}

TEST(MediaPaths, ACloudThatAbsorbsNothingCannotBeSeenUnderAWhiteSky) {
  for (const float g : {-0.5f, 0.0f, 0.8f}) {
    Stage stage(scenes::cloud_under_a_white_sky(scenes::medium({0.5f, 2, 4}, {}, cube, g)));
    expect_mean(mean_radiance(stage, 60000, 1), 1, 0.015);
  }
}

TEST(MediaPaths, FurnaceOfFogAndWalls) {
  // Walls emit what they do not reflect, and the fog emits what it absorbs: radiance is 1 everywhere.
  Scene scene = scenes::room(scenes::emissive(Rgb(0.6f), Rgb(0.4f)));
  Medium fog = scenes::medium(Rgb(0.7f), Rgb(0.5f), cube, 0.4f);
  fog.emission = Rgb(0.5f);
  scene.media.push_back(fog);
  scene.meshes.push_back(
      scenes::box({0.3f, -0.5f, -0.4f}, {0.7f, 0.3f, 0}, false, scenes::add(scene, scenes::metal(Rgb(1.0f), 0))));
  Stage stage(std::move(scene));
  expect_mean(mean_radiance(stage, 60000, 2), 1, 0.01);
}

TEST(MediaPaths, DeepInsideLightIsThatOfEquilibrium) {
  // Radiance emission / sigma_a, whatever scatters.
  Medium haze = scenes::medium(Rgb(20.0f), Rgb(12.0f), cube, 0.3f);
  haze.emission = Rgb(6.0f);
  Scene scene;
  scene.media.push_back(haze);
  scene.cameras.push_back(Camera::look_at({0, 0, 0.1f}, {0, 0, 0}, 0.5f));
  Stage stage(std::move(scene));
  expect_mean(mean_radiance(stage, 20000, 3), 0.5, 0.01);
}

TEST(MediaPaths, SingleScatteringOfAPointLightInClosedForm) {
  // Along the ray: sigma_s f(c) I / r^2 exp(-sigma_t (t + r)).
  constexpr float sigma_s = 0.3f, sigma_a = 0.1f, g = 0.5f;
  Scene scene;
  scene.media.push_back(scenes::medium(Rgb(sigma_s), Rgb(sigma_a), {{-5, -5, -5}, {5, 5, 5}}, g));
  PunctualLight light;
  light.position = {0.5f, 0.7f, 0};
  light.intensity = Rgb(3.0f);
  scene.lights.push_back(light);
  scene.cameras.push_back(Camera::look_at({-4, 0, 0}, {0, 0, 0}, 0.5f));
  Stage stage(std::move(scene));
  stage.world.max_depth = 1;
  const Ray ray{{-4, 0, 0}, {1, 0, 0}};
  double expected = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double t = 9 * (i + 0.5) / steps, dx = 4.5 - t, r2 = dx * dx + 0.49, r = std::sqrt(r2);
    const double d = 1 + g * g - 2 * g * (dx / r);
    const double phase = (1 - g * g) / (4 * M_PI * d * std::sqrt(d));
    expected += 9.0 / steps * sigma_s * phase * 3 / r2 * std::exp(-(sigma_s + sigma_a) * (t + r));
  }
  expect_mean(mean_radiance(stage, 200000, 4, ray), expected, 0.01);
}

/// Chandrasekhar's H for isotropic scattering of albedo w, by fixed-point iteration of
/// 1/H(mu) = sqrt(1 - w) + w/2 int mu' H(mu') / (mu + mu') dmu'.
class ChandrasekharH {
 public:
  explicit ChandrasekharH(double w) : w_(w), h_(n, 1.0) {
    for (int round = 0; round < 400; ++round)
      for (int i = 0; i < n; ++i) h_[i] = (*this)((i + 0.5) / n);
  }
  double operator()(double mu) const {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double other = (i + 0.5) / n;
      sum += other * h_[i] / (mu + other) / n;
    }
    return 1 / (std::sqrt(1 - w_) + w_ / 2 * sum);
  }

 private:
  static constexpr int n = 200;
  double w_;
  std::vector<double> h_;
};

TEST(MediaPaths, AThickSlabReflectsAsChandrasekharSays) {
  constexpr float albedo = 0.8f, sigma = 100;
  Scene scene;
  scene.media.push_back(scenes::medium(Rgb(albedo * sigma), Rgb((1 - albedo) * sigma), {{-5, -1, -5}, {5, 0, 5}}));
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  sun.direction = normalize(Vec3{0.6f, -0.8f, 0});
  sun.intensity = Rgb(2.0f);
  scene.lights.push_back(sun);
  scene.cameras.push_back(Camera::look_at({0, 1, 0}, {0, 0, 0}, 0.5f));
  Stage stage(std::move(scene));
  const ChandrasekharH h(albedo);
  const double in = 0.8;
  for (const double out : {1.0, 0.5}) {
    const Vec3 d(Vec3d{0, -out, std::sqrt(1 - out * out)});
    const double expected = albedo / (4 * M_PI) * in / (in + out) * h(in) * h(out) * 2;
    expect_mean(mean_radiance(stage, 100000, 5, Ray{Vec3{0, 0.5f, 0} - d * 0.1f, d}), expected, 0.01);
  }
}

TEST(MediaPaths, LampsAndScatteringShareTheirWork) {
  // Single scattering of a lamp near the ray: light sampling and phase sampling weighed by MIS against integration over
  // lamp and ray.
  constexpr float sigma = 0.8f, g = 0.7f;
  Scene scene;
  Material lamp = scenes::emissive(Rgb(0.0f), Rgb(5.0f));
  lamp.double_sided = true;
  scene.meshes.push_back(scenes::quad({-0.5f, -0.5f, 1}, {1, 0, 0}, {0, 1, 0}, scenes::add(scene, lamp)));
  scene.media.push_back(scenes::medium(Rgb(sigma), {}, {{-2, -2, -2}, {2, 2, 2}}, g));
  scene.cameras.push_back(Camera::look_at({-1, 0, 0}, {0, 0, 0}, 0.5f));
  Stage stage(std::move(scene));
  stage.world.max_depth = 1;
  const Ray ray{{-1, 0, 0.5f}, {1, 0, 0}};
  double expected = 0;
  constexpr int along = 300, across = 60;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k) {
        const double t = 3 * (i + 0.5) / along;
        const Vec3d x{t - 1, 0, 0.5}, y{(j + 0.5) / across - 0.5, (k + 0.5) / across - 0.5, 1};
        const Vec3d way = y - x;
        const double r = length(way), d = 1 + g * g - 2 * g * way.x / r;
        expected += 3.0 / (along * across * across) * sigma * (1 - g * g) / (4 * M_PI * d * std::sqrt(d)) * 5 *
                    (way.z / r) / (r * r) * std::exp(-sigma * (t + r));
      }
  expect_mean(mean_radiance(stage, 100000, 6, ray), expected, 0.01);
}

TEST(MediaPaths, UnitsOfLengthDoNotMatter) {
  // Positions by s, coefficients by 1/s: exactly the same picture for powers of two.
  Estimate means[2];
  for (int i = 0; i < 2; ++i) {
    const float s = i == 0 ? 1.0f : 0x1p-10f;
    Scene scene = scenes::cornell_box(s);
    scene.media.push_back(
        scenes::medium(Rgb{0.5f, 0.3f, 0.1f} / s, Rgb(0.1f / s), {Vec3{-1, 0, -1} * s, Vec3{1, 2, 1} * s}, 0.3f));
    Stage stage(std::move(scene));
    means[i] = mean_radiance(stage, 4000, 7);
  }
  EXPECT_EQ(means[0].mean(), means[1].mean());
}

}  // namespace
}  // namespace isophote
