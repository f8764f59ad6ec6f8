#include <gtest/gtest.h>

#include <array>

#include "isophote/scene/density_grid.h"
#include "isophote/trace/media.h"
#include "support/media.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

const Box cube{{-1, -1, -1}, {1, 1, 1}};

Sampler sampler_of(std::uint64_t seed, int i) { return {Purpose::test, seed, static_cast<std::uint64_t>(i), 0}; }

Scene scene_of(std::initializer_list<Medium> media) {
  Scene scene;
  scene.media = media;
  return scene;
}

/// The integral of density over a ray, by the midpoint rule.
double column_by_steps(const HeightDensity& d, const Ray& ray) {
  double sum = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double t = ray.near + (ray.far - ray.near) * (i + 0.5) / steps;
    sum += std::exp((d.base - (ray.origin.y + t * ray.direction.y)) / d.height) * (ray.far - ray.near) / steps;
  }
  return sum;
}

TEST(Media, TransmittanceOfUniformAndHeightFog) {
  const Rgb sigma{0.3f, 0.8f, 1.7f};
  Medium fog = scenes::medium(sigma, {}, cube);
  const Scene uniform = scene_of({fog});
  const Ray across{{-3, 0.2f, 0.1f}, {1, 0, 0}, 0, 10};
  const Rgb passed = Media(uniform).transmittance(across, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(passed[c], std::exp(-2.0 * sigma[c]), 1e-6);

  const HeightDensity falling{-0.5f, 0.4f};
  fog.density = falling;
  const Scene height = scene_of({fog});
  const Media media(height);
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0.6f, 0.8f, 0}, Vec3{1, 1e-7f, 0}}) {
    const Ray inside{{0, -0.3f, 0}, normalize(d), 0, 0.6f};
    const double column = column_by_steps(falling, inside);
    const Rgb through = media.transmittance(inside, 0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(through[c], std::exp(-column * sigma[c]), 2e-6) << d.x << " " << d.y;
  }
}

TEST(Media, HeightFogIsMetFromFarAbove) {
  // Where its density is less than any number.
  for (const auto& [scale, top] : {std::pair{1.0f, 120.0f}, {0.05f, 40.0f}, {1.0f, 650.0f}}) {
    Medium fog = scenes::medium(Rgb(0.6f / scale), {}, {{-1, 0, -1}, {1, top, 1}});
    fog.density = HeightDensity{0, scale};
    const Scene scene = scene_of({fog});
    const Media media(scene);
    const Ray down{{0, top + 1, 0}, {0, -1, 0}, 0, infinity}, up{{0, -1, 0}, {0, 1, 0}, 0, infinity};
    for (const Ray& ray : {down, up}) {
      EXPECT_NEAR(media.transmittance(ray, 0).g, std::exp(-0.6), 1e-5) << scale << " " << top;
      Estimate passed;
      for (int i = 0; i < 20000; ++i) {
        Sampler sampler = sampler_of(5, i);
        Rgb throughput(1.0f), emission;
        passed.add(media.collide(ray, sampler, throughput, emission) ? 0 : throughput.g);
      }
      expect_mean(passed, std::exp(-0.6), 0.02);
    }
    const float depth = top + 1;
    Media::Passage passage;
    media.along(down, {&depth, 1}, {&passage, 1});
    EXPECT_NEAR(passage.transmittance.g, std::exp(-0.6), 1e-5);
    EXPECT_TRUE(is_finite(passage.log_gradient.x + passage.log_gradient.y + passage.log_gradient.z));
  }
}

/// What a ray sees of sources of sigma_s each, by points chosen along it.
std::array<Estimate, 3> seen_of_sources(const Scene& scene, const Ray& ray) {
  const Media media(scene);
  std::array<Estimate, 3> seen;
  for (int i = 0; i < 4000; ++i) {
    Sampler sampler = sampler_of(6, i);
    Rgb sum;
    for (const Media::RayPoint& at : media.sample_points(ray, 2, sampler))
      sum += at.scattering * media.transmittance({ray.origin, ray.direction, 0, at.distance}, sampler.next_bits()) *
             at.length;
    for (int c = 0; c < 3; ++c) seen[c].add(sum[c]);
  }
  return seen;
}

TEST(Media, PointsAreFoundWhereAnyChannelSees) {
  const Rgb absorption{50, 0.05f, 0.3f};
  const Scene scene = scene_of({scenes::medium(Rgb(0.05f), absorption, cube)});
  const auto seen = seen_of_sources(scene, {{-3, 0, 0}, {1, 0, 0}, 0, infinity});
  for (int c = 0; c < 3; ++c) {
    const double sigma = absorption[c] + 0.05;
    expect_mean(seen[c], 0.05 * (1 - std::exp(-2 * sigma)) / sigma, 0.1);
  }
}

TEST(Media, PointsAreFoundBehindEmptyAirInADenseGrid) {
  constexpr int n = 32;
  std::vector<float> values;
  for (int i = 0; i < n * n * n; ++i) values.push_back(i % n < 24 ? 0.0f : 1.0f);
  const double size = 2.0 / (n - 1);
  Affine to_world;
  to_world.x = {size, 0, 0}, to_world.y = {0, size, 0}, to_world.z = {0, 0, size}, to_world.origin = {-1, -1, -1};
  Medium smoke = scenes::medium(Rgb(900), Rgb(100), cube);
  smoke.density = DensityGrid::from_values({n, n, n}, std::move(values), to_world);
  const Scene scene = scene_of({smoke});
  for (const Estimate& e : seen_of_sources(scene, {{-3, 0, 0}, {1, 0, 0}, 0, infinity})) expect_mean(e, 0.9, 0.15);
}

TEST(Media, FlightsEndInWhatIsAsGoodAsSolid) {
  // Red goes no further than the first event, the rest straight through; and of what only glows, density may be huge.
  Medium glow = scenes::medium({}, {}, {{-1, 0, -1}, {1, 1, 1}});
  glow.emission = Rgb(1e-26f), glow.density = HeightDensity{60, 1};
  const Scene scene = scene_of({scenes::medium({1e9f, 0, 0}, {}, cube), glow});
  const Media media(scene);
  Estimate green, emitted;
  for (int i = 0; i < 4000; ++i) {
    Sampler sampler = sampler_of(91, i);
    Rgb throughput(1.0f), emission;
    const auto met = media.collide({{-2, 0.5f, 0}, {1, 0, 0}, 0, 4}, sampler, throughput, emission);
    green.add(met ? 0 : throughput.g);
    emitted.add(emission.g);
  }
  expect_mean(green, 1, 0.05);
  expect_mean(emitted, 2 * 1e-26 * std::exp(59.5), 0.05);
}

TEST(Media, OverlappingMediaAddUp) {
  const Scene scene = scene_of({scenes::medium(Rgb(0.5f), {}, cube), scenes::medium({}, Rgb(0.25f), cube)});
  const Media media(scene);
  EXPECT_EQ(media.holding({0, 0, 0}), 3u);
  EXPECT_EQ(media.holding({0, 2, 0}), 0u);
  EXPECT_NEAR(media.transmittance({{-2, 0, 0}, {1, 0, 0}, 0, 4}, 0).g, std::exp(-1.5), 1e-6);
}

TEST(Media, MeshBoundsAreThoseOfTheBoxTheyMake) {
  Medium fog = scenes::medium(Rgb(0.5f), Rgb(0.2f), {{-0.5f, -0.4f, -0.3f}, {0.5f, 0.4f, 0.3f}});
  const Scene box = scene_of({fog});
  fog.bounds = scenes::closed_box({-0.5f, -0.4f, -0.3f}, {0.5f, 0.4f, 0.3f});
  const Scene mesh = scene_of({fog});
  const Media by_box(box), by_mesh(mesh);
  statistics::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1};
    const Vec3 to = Vec3{random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.5f};
    const Ray ray{p, normalize(to), 0, random.next() < 0.5f ? infinity : 0.5f};
    EXPECT_NEAR(by_box.transmittance(ray, 0).r, by_mesh.transmittance(ray, 0).r, 1e-5);
    EXPECT_EQ(by_box.holding(p), by_mesh.holding(p));
  }
}

/// What light that came from a collision or from the end counts on average, per channel: in closed form for a uniform
/// medium, which scatters within [0, 2] with density sigma_s exp(-sigma_t t).
TEST(Media, CollisionsWeighAsTheMediumScatters) {
  const Rgb scattering{0.2f, 0.9f, 1.4f}, absorption{0.5f, 0.1f, 0.4f};
  const Scene scene = scene_of({scenes::medium(scattering, absorption, cube)});
  const Media media(scene);
  std::array<Estimate, 3> passed, early, late;
  for (int i = 0; i < 200000; ++i) {
    Sampler sampler = sampler_of(1, i);
    Rgb throughput(1.0f), emission;
    const auto at = media.collide({{-3, 0, 0}, {1, 0, 0}, 0, infinity}, sampler, throughput, emission);
    for (int c = 0; c < 3; ++c) {
      passed[c].add(at ? 0 : throughput[c]);
      early[c].add(at && at->position.x < -0.5f ? throughput[c] : 0);
      late[c].add(at && at->position.x >= -0.5f ? throughput[c] : 0);
    }
  }
  for (int c = 0; c < 3; ++c) {
    const double s = scattering[c], t = s + absorption[c];
    expect_mean(passed[c], std::exp(-2 * t), 0.02);
    expect_mean(early[c], s / t * (1 - std::exp(-0.5 * t)), 0.02);
    expect_mean(late[c], s / t * (std::exp(-0.5 * t) - std::exp(-2 * t)), 0.02);
  }
}

TEST(Media, FlightsThroughHeightFogAndTwoMedia) {
  Medium fog = scenes::medium(Rgb(0.3f), Rgb(0.1f), cube);
  const HeightDensity falling{0, 0.5f};
  fog.density = falling;
  const Scene scene = scene_of({fog, scenes::medium({0.3f, 0.6f, 0.3f}, Rgb(0.2f), cube)});
  const Media media(scene);
  const Ray ray{{0, -0.9f, 0}, normalize(Vec3{0.3f, 1, 0}), 0, 1.5f};
  Estimate passed, first, second;
  for (int i = 0; i < 100000; ++i) {
    Sampler sampler = sampler_of(2, i);
    Rgb throughput(1.0f), emission;
    const auto at = media.collide(ray, sampler, throughput, emission);
    passed.add(at ? 0 : throughput.g);
    first.add(at && at->medium == 0 ? throughput.g : 0);
    second.add(at && at->medium == 1 ? throughput.g : 0);
  }
  expect_mean(passed, media.transmittance(ray, 0).g, 0.03);
  double by_first = 0, by_second = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const float t = 1.5f * (static_cast<float>(i) + 0.5f) / steps;
    const double here = media.transmittance({ray.origin, ray.direction, 0, t}, 0).g * 1.5 / steps;
    by_first += here * 0.3 * std::exp(-(ray.origin.y + t * ray.direction.y) / 0.5);
    by_second += here * 0.6;
  }
  expect_mean(first, by_first, 0.02);
  expect_mean(second, by_second, 0.02);
}

TEST(Media, EmissionAlongARay) {
  Medium glow = scenes::medium(Rgb(0.4f), Rgb(0.6f), cube);
  glow.emission = {2, 3, 4};
  Medium flame = scenes::medium({}, {}, cube);
  flame.emission = Rgb(1.0f);
  const Scene glowing = scene_of({glow}), burning = scene_of({flame});
  const Media a(glowing), b(burning);
  Estimate of_glow, of_flame;
  for (int i = 0; i < 100000; ++i) {
    Sampler sampler = sampler_of(3, i);
    Rgb throughput(1.0f), emission;
    a.collide({{-3, 0, 0}, {1, 0, 0}, 0, infinity}, sampler, throughput, emission);
    of_glow.add(emission.g);
    emission = {}, throughput = Rgb(1.0f);
    b.collide({{-3, 0, 0}, {1, 0, 0}, 0, infinity}, sampler, throughput, emission);
    EXPECT_EQ(throughput, Rgb(1.0f));
    of_flame.add(emission.g);
  }
  expect_mean(of_glow, 3 * (1 - std::exp(-2.0)), 0.02);
  expect_mean(of_flame, 2, 0.02);
}

}  // namespace
}  // namespace isophote
