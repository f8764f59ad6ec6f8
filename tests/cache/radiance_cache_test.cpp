#include "isophote/cache/radiance_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "isophote/derivatives/krivanek_2005b.h"
#include "isophote/harmonics/quadrature.h"
#include "support/analytic_room.h"

namespace isophote::test {
namespace {

constexpr int order = 8;
constexpr double half_turn = std::numbers::pi;

/// A smooth lobe about the mirror direction of a viewer at azimuth 0, as a table would have it: a power of a cosine.
double lobe_at(double cosine, const Vec3d& w) {
  const Vec3d mirrored{-std::sqrt(1 - cosine * cosine), 0, cosine};
  return std::pow(std::max(0.0, (1 + dot(mirrored, w)) / 2), 12.0) * w.z;
}

void set_lobe(Basis basis, Lobe& lobe, float cosine) {
  std::array<double, harmonics_count(order)> values;
  std::array<double, polar_count(order)> sums{};
  constexpr int azimuths = 48;
  GaussRule<40>::get().integrate(0, 1, [&](double z, double weight) {
    for (int k = 0; k < azimuths; ++k) {
      const double r = std::sqrt(1 - z * z), phi = 2 * half_turn * k / azimuths;
      const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
      evaluate_harmonics(basis, order, w, values);
      for (int l = 0; l < order; ++l)
        for (int m = 0; m <= l; ++m)
          sums[polar_index(l, m)] +=
              values[harmonic_index(l, m)] * lobe_at(cosine, w) * weight * 2 * half_turn / azimuths;
    }
  });
  for (int i = 0; i < polar_count(order); ++i) lobe.coefficients[i] = Rgb(static_cast<float>(sums[i]));
}

RadianceRecord record_of(const HemisphereGather& gather, Basis basis, float radius) {
  RadianceRecord record;
  record.position = gather.position, record.normal = gather.frame.n;
  record.jet = krivanek_2005b(gather, basis, order);
  record.footprint = Footprint::disk(radius, 1);
  record.footprint.order = 1;
  return record;
}

/// What the lobe reflects towards `wo` at a place of the room's floor.
double truth(const AnalyticRoom& room, double x, double y, const Vec3d& wo) {
  const double size = std::hypot(wo.x, wo.y);
  const Vec3d u{wo.x / size, wo.y / size, 0}, v{-u.y, u.x, 0};
  return room.integral(x, y, [&](const Vec3d& w) { return lobe_at(wo.z, {dot(w, u), dot(w, v), w.z}); });
}

std::optional<Rgb> reflect(const RadianceCache& cache, const Vec3& at, const Vec3& facing, const Vec3d& wo) {
  return cache.reflect({at, {0, 0, 1}, facing}, Vec3(wo), order,
                       [&](Lobe& lobe, float cosine) { set_lobe(cache.basis(), lobe, cosine); });
}

const Vec3d viewers[] = {normalize(Vec3d{0.5, 0.3, 0.8}), normalize(Vec3d{-0.6, 0.4, 0.5}),
                         normalize(Vec3d{0.1, -0.9, 0.6})};

TEST(RadianceCache, ReflectsWhatArrives) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, false);
  for (const Basis basis : {Basis::hemispherical, Basis::spherical}) {
    RadianceCache cache({{0, 0, 0}, {4, 3, 2.5f}}, basis);
    cache.insert(record_of(gather_floor(room, 0.9, 0.8, {64, 200}, 1), basis, 0.5f));
    for (const Vec3d& wo : viewers) {
      const double there = truth(room, 0.9, 0.8, wo), beside = truth(room, 0.98, 0.86, wo);
      EXPECT_NEAR(reflect(cache, {0.9f, 0.8f, 0}, {0, 0, 1}, wo)->r, there, 0.01 * there);
      // The gradient says most of what is different 0.1 away.
      EXPECT_NEAR(reflect(cache, {0.98f, 0.86f, 0}, {0, 0, 1}, wo)->r, beside,
                  0.01 * there + 0.15 * std::abs(beside - there));
    }
  }
}

// The viewer's azimuth counts in the record's frame, whichever way that lies: a record made in a turned room, seen by a
// viewer turned alike, reflects the same.
TEST(RadianceCache, TurnsWithTheRoom) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, true);
  HemisphereGather gather = gather_floor(room, 1.2, 1.3, {16, 50}, 1);
  const Vec3 normal = normalize(Vec3{0.3f, -0.5f, 0.8f});
  const Frame turned(normal);
  RadianceCache flat({{0, 0, 0}, {4, 3, 2.5f}}, Basis::hemispherical), tilted = flat;
  flat.insert(record_of(gather, Basis::hemispherical, 0.5f));
  gather.frame = turned;
  for (GatherSample& s : gather.samples)
    s.direction = turned.to_world(s.direction), s.normal = turned.to_world(s.normal);
  tilted.insert(record_of(gather, Basis::hemispherical, 0.5f));
  const Vec3 step{0.05f, -0.08f, 0};
  for (const Vec3d& wo : viewers) {
    const Rgb a = *reflect(flat, gather.position + step, {0, 0, 1}, wo);
    const Vec3 there = turned.to_world(Vec3(wo));
    const Rgb b = *tilted.reflect({gather.position + turned.to_world(step), normal, normal}, there, order,
                                  [&](Lobe& lobe, float cosine) { set_lobe(Basis::hemispherical, lobe, cosine); });
    EXPECT_NEAR(a.r, b.r, 2e-5 * a.r);
  }
}

// A normal map turns the lobe: the light that is mirrored comes from where it comes from in the world.
TEST(RadianceCache, ANormalMapMovesTheMirrorDirection) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, false);
  RadianceCache cache({{0, 0, 0}, {4, 3, 2.5f}}, Basis::hemispherical);
  cache.insert(record_of(gather_floor(room, 0.9, 0.8, {64, 200}, 1), Basis::hemispherical, 0.5f));
  const Vec3d wo = viewers[0], facing = normalize(Vec3d{0.1, 0.05, 1}), mirrored = facing * (2 * dot(facing, wo)) - wo;
  const Vec3d seen_from{-mirrored.x, -mirrored.y, mirrored.z};
  const double expected = truth(room, 0.9, 0.8, seen_from);
  EXPECT_NEAR(reflect(cache, {0.9f, 0.8f, 0}, Vec3(facing), wo)->r, expected, 0.01 * expected);
}

TEST(RadianceCache, RecordsOfTooFewBandsDoNotServe) {
  RadianceCache cache({{0, 0, 0}, {4, 3, 2.5f}}, Basis::hemispherical);
  const HemisphereGather gather = gather_floor(AnalyticRoom(AnalyticRoom::Walls::constant, false), 0.9, 0.8, {8, 25});
  RadianceRecord record = record_of(gather, Basis::hemispherical, 0.5f);
  record.jet = krivanek_2005b(gather, Basis::hemispherical, order - 1);
  cache.insert(record);
  const Query query{gather.position, {0, 0, 1}, {0, 0, 1}};
  EXPECT_TRUE(cache.covers(query, order - 1));
  EXPECT_FALSE(cache.covers(query, order));
  EXPECT_FALSE(reflect(cache, gather.position, {0, 0, 1}, viewers[0]));
  cache.insert(record_of(gather, Basis::hemispherical, 0.5f));
  EXPECT_TRUE(cache.covers(query, order));
  EXPECT_TRUE(reflect(cache, gather.position, {0, 0, 1}, viewers[0]));
}

TEST(RadianceCache, TheOtherSideIsNotServed) {
  RadianceCache cache({{0, 0, 0}, {4, 3, 2.5f}}, Basis::hemispherical);
  const HemisphereGather gather = gather_floor(AnalyticRoom(AnalyticRoom::Walls::constant, false), 0.9, 0.8, {8, 25});
  RadianceRecord record = record_of(gather, Basis::hemispherical, 0.5f);
  record.footprint = Footprint::disk(0.5f, 0.1f);  // that hardly minds how a surface is turned
  cache.insert(record);
  EXPECT_TRUE(reflect(cache, gather.position, {0, 0, 1}, viewers[0]));
  EXPECT_FALSE(cache.covers({gather.position, {0, 0, -1}, {0, 0, -1}}, order));
  EXPECT_FALSE(cache.reflect({gather.position, {0, 0, -1}, {0, 0, -1}}, {0, 0, -1}, order, [](Lobe&, float) {}));
}

// Where bands that are left out leave a negative rest, nothing is reflected instead.
TEST(RadianceCache, NeverNegative) {
  RadianceCache cache({{0, 0, 0}, {4, 3, 2.5f}}, Basis::hemispherical);
  const HemisphereGather gather = gather_floor(AnalyticRoom(AnalyticRoom::Walls::constant, false), 0.9, 0.8, {8, 25});
  cache.insert(record_of(gather, Basis::hemispherical, 0.5f));
  const auto dark = [](Lobe& lobe, float) { lobe.coefficients.fill(Rgb(-1.0f)); };
  EXPECT_EQ(cache.reflect({gather.position, {0, 0, 1}, {0, 0, 1}}, {0, 0, 1}, order, dark), Rgb{});
}

}  // namespace
}  // namespace isophote::test
