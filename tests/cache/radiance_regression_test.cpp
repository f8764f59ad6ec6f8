#include "isophote/cache/radiance_regression.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/records.h"

namespace isophote::test {
namespace {

constexpr int bands = 3, count = harmonics_count(bands);

/// Records scattered over a square of a plane, of coefficients that are linear in position, plus noise in the values.
RadianceCache plane(float noise) {
  RadianceCache cache({{0, 0, 0}, {1, 1, 0}}, Basis::hemispherical);
  RandomPlaces random(5);
  const Frame frame(Vec3{0, 0, 1});
  for (int n = 0; n < 200; ++n) {
    RadianceRecord r;
    r.position = random.point({0, 0, 0}, {1, 1, 0}), r.normal = frame.n;
    r.footprint = Footprint::disk(0.15f, 1);
    r.footprint.order = 1;
    r.jet.rays = 100, r.jet.distances.harmonic_mean = 1;
    for (int i = 0; i < count; ++i) {
      const Rgb by_u(static_cast<float>(i) - 3), by_v(0.5f * static_cast<float>(i));
      const float du = dot(r.position, frame.u), dv = dot(r.position, frame.v);
      r.jet.value.push_back(Rgb(10.0f) + by_u * du + by_v * dv + Rgb(random.number(-noise, noise)));
      r.jet.translational.x.push_back(by_u), r.jet.translational.y.push_back(by_v);
    }
    cache.insert(r);
  }
  return cache;
}

double spread(const RadianceRecord& r, const RadianceRecord& truth) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += std::pow(r.jet.value[i].g - truth.jet.value[i].g, 2);
  return sum;
}

TEST(RadianceRegression, LeavesAPlaneAsItIs) {
  const RadianceCache cache = plane(0);
  const RadianceRegression regression(cache);
  for (std::uint32_t id = 0; id < cache.records().size(); ++id) {
    const RadianceRecord &before = cache.records()[id], after = regression.fitted(id, {});
    for (int i = 0; i < count; ++i) {
      EXPECT_NEAR(after.jet.value[i].r, before.jet.value[i].r, 1e-5f);
      EXPECT_NEAR(after.jet.translational.x[i].r, before.jet.translational.x[i].r, 1e-4f);
      EXPECT_NEAR(after.jet.translational.y[i].r, before.jet.translational.y[i].r, 1e-4f);
    }
    EXPECT_EQ(after.footprint.radius, before.footprint.radius);
  }
}

TEST(RadianceRegression, TakesNoiseOut) {
  const RadianceCache noisy = plane(1), exact = plane(0);
  const RadianceRegression regression(noisy);
  double before = 0, after = 0;
  for (std::uint32_t id = 0; id < noisy.records().size(); ++id) {
    // The same places: random numbers are drawn alike.
    ASSERT_EQ(noisy.records()[id].position, exact.records()[id].position);
    before += spread(noisy.records()[id], exact.records()[id]);
    after += spread(regression.fitted(id, {}), exact.records()[id]);
  }
  EXPECT_LT(after, before / 5);
}

TEST(RadianceRegression, DoesNotReachWhatIsHidden) {
  const RadianceCache cache = plane(1);
  RadianceCache wary = cache;
  for (RadianceRecord& r : wary.settling().records)
    for (int s = 0; s < Obstacles::sectors; ++s) r.jet.distances.obstacles.meet(s, 0);
  const RadianceRegression regression(wary);
  const auto same = [](const Site& from, const Query& to) { return from.position == to.position; };
  for (std::uint32_t id = 0; id < 20; ++id) {
    const RadianceRecord &before = wary.records()[id], after = regression.fitted(id, same);
    for (int i = 0; i < count; ++i) EXPECT_NEAR(after.jet.value[i].r, before.jet.value[i].r, 1e-5f);
  }
}

// What a tilt does to coefficients is not known, so that records of a bent surface say nothing of each other.
TEST(RadianceRegression, LeavesABentSurfaceAlone) {
  RadianceCache cache({{-1, -1, -1}, {1, 1, 1}}, Basis::hemispherical);
  for (int n = 0; n < 40; ++n) {
    const float angle = 0.1f * static_cast<float>(n);
    RadianceRecord r;
    r.position = r.normal = {std::cos(angle), std::sin(angle), 0};
    r.footprint = Footprint::disk(0.3f, 1);
    r.footprint.order = 1;
    r.jet.rays = 100, r.jet.distances.harmonic_mean = 1;
    for (int i = 0; i < count; ++i) r.jet.value.emplace_back(std::sin(3 * angle + static_cast<float>(i)));
    r.jet.translational.x = r.jet.translational.y = Coefficients(count);
    cache.insert(r);
  }
  const RadianceRegression regression(cache);
  for (std::uint32_t id = 0; id < cache.records().size(); ++id)
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(regression.fitted(id, {}).jet.value[i].g, cache.records()[id].jet.value[i].g, 1e-6f);
}

TEST(RadianceRegression, LeavesOutNeighboursWithoutGradients) {
  RadianceCache cache = plane(1);
  for (std::uint32_t id = 1; id < cache.records().size(); ++id) cache.settling().records[id].jet.translational = {};
  const RadianceRecord &before = cache.records()[0], after = RadianceRegression(cache).fitted(0, {});
  for (int i = 0; i < count; ++i) EXPECT_NEAR(after.jet.value[i].r, before.jet.value[i].r, 1e-5f);
}

}  // namespace
}  // namespace isophote::test
