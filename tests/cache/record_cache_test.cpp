#include "isophote/cache/record_cache.h"

#include <gtest/gtest.h>

#include <numbers>

#include "isophote/core/ray.h"
#include "isophote/validity/bounded_split_sphere.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr Box room{{0, 0, 0}, {4, 3, 2.5f}};
constexpr Vec3 up{0, 0, 1};

Query query(const Vec3& position, const Vec3& normal) { return {position, normal, normal}; }

/// Records of every kind all over the room: round and elongated, both weights, both orders, any normal.
std::vector<Record> many_records(int count, RandomPlaces& random) {
  std::vector<Record> records;
  for (int i = 0; i < count; ++i) {
    Record r = round_record(random.point(room.lower, room.upper), random.direction(), random.number(0.02f, 0.6f), 0.7f);
    r.footprint.shape.xx *= random.number(1, 4);
    r.footprint.falloff = i % 2 ? Falloff::tent : Falloff::ward;
    r.footprint.order = i % 3 ? 1 : 0;
    r.gradient_scale = random.number(0, 1);
    r.jet.value = random.colour(0, 2);
    r.jet.translational = random.gradient(1);
    r.jet.rotational = random.gradient(1);
    records.push_back(r);
  }
  return records;
}

/// The published sum over all records, in doubles.
std::optional<Rgbd> interpolate_naively(std::span<const Record> records, const Query& q) {
  Rgbd sum;
  double weights = 0;
  for (const Record& r : records) {
    const Vec3d d(q.position - r.position);
    const Footprint& f = r.footprint;
    if (dot(d, Vec3d(q.normal + r.normal)) / 2 < -0.05 * f.radius || dot(q.normal, r.normal) <= 0) continue;
    const double error = std::sqrt(f.shape.xx * d.x * d.x + f.shape.yy * d.y * d.y + f.shape.zz * d.z * d.z) +
                         f.normal_scale * length(Vec3d(q.normal) - Vec3d(r.normal)) / std::numbers::sqrt2;
    if (error >= 1) continue;
    const double weight = f.falloff == Falloff::tent ? 1 - error : 1 / error - 1;
    sum += Rgbd(r.extrapolate(q.position - r.position, q.facing)) * weight;
    weights += weight;
  }
  if (weights == 0) return std::nullopt;
  return sum / weights;
}

void expect_near(const std::optional<Rgb>& a, const std::optional<Rgbd>& b, double tolerance) {
  ASSERT_EQ(a.has_value(), b.has_value());
  for (int c = 0; a && c < 3; ++c) EXPECT_NEAR((*a)[c], (*b)[c], tolerance);
}

RecordCache cache_of(std::span<const Record> records) {
  RecordCache cache(room);
  for (const Record& r : records) cache.insert(r);
  return cache;
}

TEST(RecordCache, InterpolatesAsASumOverAllRecords) {
  RandomPlaces random(11);
  const std::vector<Record> records = many_records(3000, random);
  const RecordCache cache = cache_of(records);
  int served = 0;
  for (int i = 0; i < 3000; ++i) {
    Query q = query(random.point(room.lower, room.upper), random.direction());
    q.facing = random.direction_near(q.normal, 0.3f);
    const auto value = cache.interpolate(q);
    expect_near(value, interpolate_naively(records, q), 2e-5);
    EXPECT_EQ(cache.covers(q), value.has_value());
    served += value.has_value();
  }
  EXPECT_GT(served, 500);
  EXPECT_LT(served, 2900);
}

// At a record's own place its error is exactly zero, and Ward's weight leaves nothing to the others.
TEST(RecordCache, ARecordIsItsOwnValue) {
  RandomPlaces random(5);
  RecordCache cache(room);
  for (int i = 0; i < 200; ++i) {
    Record r = round_record(random.point({0, 0, 0}, {4, 3, 0}), random.direction_near(up, 0.1f), 0.5f, 5);
    r.jet.value = random.colour(0.5f, 1);
    cache.insert(r);
  }
  for (const Record& r : cache.records()) {
    EXPECT_EQ(footprint_error(r, r.position, r.normal), 0);
    const auto value = cache.interpolate(query(r.position, r.normal));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR((*value)[c], r.jet.value[c], 1e-4);
  }
}

TEST(RecordCache, Weights) {
  EXPECT_FLOAT_EQ(falloff_weight(Falloff::tent, 0.25f), 0.75f);
  EXPECT_FLOAT_EQ(falloff_weight(Falloff::ward, 0.25f), 3);
  for (const Falloff falloff : {Falloff::tent, Falloff::ward}) {
    const float last = 0x1.fffffep-1f;  // nothing pops at the rim, and yet every record that covers counts
    EXPECT_GT(falloff_weight(falloff, last), 0);
    EXPECT_LT(falloff_weight(falloff, last), 1e-6f);
    EXPECT_TRUE(std::isfinite(falloff_weight(falloff, 0)));
    for (float t = 0; t < 0.99f; t += 0.01f) EXPECT_GE(falloff_weight(falloff, t), falloff_weight(falloff, t + 0.01f));
  }
  RecordCache cache(room);
  Record left = round_record({1, 1, 0}, up, 1), right = round_record({2, 1, 0}, up, 1);
  left.jet.value = Rgb(1), right.jet.value = Rgb(5);
  cache.insert(left), cache.insert(right);
  // errors 1/4 and 3/4: Ward's weights are 3 and 1/3
  EXPECT_FLOAT_EQ(cache.interpolate(query({1.25f, 1, 0}, up))->r, (3 * 1 + 5 / 3.0f) / (3 + 1 / 3.0f));
}

TEST(RecordCache, EmptyPlaces) {
  RecordCache cache(room);
  EXPECT_FALSE(cache.interpolate(query({1, 1, 0}, up)));
  EXPECT_FALSE(cache.covers(query({1, 1, 0}, up)));
  cache.insert(round_record({1, 1, 0}, up, 0.1f));
  EXPECT_FALSE(cache.covers(query({1.11f, 1, 0}, up)));
  EXPECT_TRUE(cache.covers(query({1.09f, 1, 0}, up)));
}

// Irradiance that is linear in position and in the normal, E = c + g . x + b . n, comes back as it is: the
// translational gradient is g, and the rotational one n_i x b is exact but for the part along n_i, which shrinks by the
// cosine.
TEST(RecordCache, FirstOrderReproducesALinearField) {
  RandomPlaces random(23);
  const Vec3 g{0.3f, -0.2f, 0.1f}, b{0.4f, 0.5f, 0.3f};
  RecordCache cache(room);
  for (int i = 0; i < 500; ++i) {
    Record r = round_record(random.point({0, 0, 0}, {4, 3, 0.01f}), random.direction_near(up, 0.05f), 0.4f, 1);
    r.footprint.order = 1;
    const Vec3 turn = cross(r.normal, b);
    r.jet.value = Rgb(5 + dot(g, r.position) + dot(b, r.normal));
    r.jet.translational = {Rgb(g.x), Rgb(g.y), Rgb(g.z)};
    r.jet.rotational = {Rgb(turn.x), Rgb(turn.y), Rgb(turn.z)};
    cache.insert(r);
  }
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random.point({0, 0, 0}, {4, 3, 0.01f}), facing = random.direction_near(up, 0.02f);
    const auto value = cache.interpolate({p, up, facing});
    ASSERT_TRUE(value);
    EXPECT_NEAR(value->r, 5 + dot(g, p) + dot(b, facing),
                0.004);  // 1 - cos of the 5 degrees between normals, times b . n
    const auto same = cache.interpolate({p, up, up});
    EXPECT_NEAR(same->g, 5 + dot(g, p) + dot(b, up), 0.002);
  }
}

// A normal map turns what a record knows; which records serve is decided by the surface alone.
TEST(RecordCache, MappedNormalsActThroughTheRotationalGradient) {
  const Vec3 b{0.4f, 0.5f, 0.3f}, turn = cross(up, b);
  Record r = round_record({1, 1, 0}, up, 0.5f, 100);
  r.footprint.order = 1;
  r.jet.value = Rgb(1 + b.z);
  r.jet.rotational = {Rgb(turn.x), Rgb(turn.y), Rgb(turn.z)};
  RecordCache cache(room);
  cache.insert(r);
  for (const Vec3& facing : {normalize(Vec3{0.3f, 0, 1}), normalize(Vec3{-0.5f, 0.2f, 1}), Vec3{1, 0, 0}}) {
    const auto value = cache.interpolate({{1, 1, 0}, up, facing});
    ASSERT_TRUE(value);  // however far the map turns
    EXPECT_NEAR(value->r, 1 + b.z + b.x * facing.x + b.y * facing.y, 1e-6);
    EXPECT_EQ(cache.covers({{1, 1, 0}, up, facing}), true);
  }
  EXPECT_FALSE(cache.covers(query({1, 1, 0}, normalize(Vec3{0.3f, 0, 1}))));
}

/// Saw something `near` away all round.
Record wary_record(const Vec3& position, float radius, float near, float value) {
  Record record = round_record(position, up, radius);
  record.jet.value = Rgb(value);
  for (int i = 0; i < Obstacles::sectors; ++i) record.jet.distances.obstacles.meet(i, near);
  return record;
}

TEST(OpenTest, IsAskedOfRecordsThatServeBeyondWhatTheySawAlone) {
  const Record wary = wary_record({1, 1, 0}, 1, 0.5f, 1);
  RecordCache cache(room);
  cache.insert(wary);
  cache.insert(round_record({1, 1.5f, 0}, up, 1));  // saw nothing near
  int asked = 0;
  const auto open = [&](const Site& record, const Query& q) {
    EXPECT_EQ(record.position, wary.position);
    EXPECT_GT(length(q.position - record.position), 0.39f);
    ++asked;
    return true;
  };
  RandomPlaces random(53);
  int expected = 0;
  for (int i = 0; i < 300; ++i) {
    const Query q = query(random.point({0, 0, 0}, {2, 2, 0}), up);
    const float distance = length(q.position - wary.position);
    if (std::abs(distance - 0.4f) < 0.01f || std::abs(distance - 1) < 1e-5f) continue;
    expected += distance > 0.4f && distance < 1;
    EXPECT_EQ(cache.interpolate(q, open), cache.interpolate(q));
    EXPECT_EQ(asked, expected);
  }
  EXPECT_GT(asked, 100);
  EXPECT_EQ(serving_error(wary, query({1, 1.7f, 0}, up), {}), footprint_error(wary, {1, 1.7f, 0}, up));
}

TEST(OpenTest, WhatItRefusesDoesNotServe) {
  RecordCache cache(room);
  cache.insert(wary_record({1, 1, 0}, 1, 0.2f, 5));
  const auto wall = [](const Site& record, const Query& q) {
    return (record.position.x < 1.5f) == (q.position.x < 1.5f);
  };
  const Query before = query({1.4f, 1, 0}, up), behind = query({1.6f, 1, 0}, up);
  EXPECT_TRUE(cache.covers(before, wall));
  EXPECT_FALSE(cache.covers(behind, wall));
  EXPECT_FALSE(cache.interpolate(behind, wall));
  EXPECT_TRUE(cache.covers(behind));
  cache.insert(wary_record({1.6f, 1, 0}, 1, 0, 3));  // its own place is always open
  EXPECT_EQ(cache.interpolate(behind, wall), Rgb(3));
  EXPECT_EQ(cache.interpolate(before, wall), Rgb(5));
  EXPECT_EQ(serving_error(cache.records()[0], behind, wall), infinity);
}

// On a sphere, seen from outside as from inside, the plane between two points' normals holds both: records serve all
// their neighbours. A test against the record's own tangent plane would refuse every one of them on the convex side.
TEST(InFront, ConvexAndConcaveSurfacesShareRecords) {
  RandomPlaces random(31);
  const float sphere_radius = 2;
  for (const float side : {1.0f, -1.0f}) {
    int neighbours = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 n = random.direction(), m = random.direction_near(n, 0.5f);
      const Record r = round_record(n * sphere_radius, n * side, 0.5f, 0.5f);
      const float d = length(m * sphere_radius - r.position);
      const double expected = d / 0.5 + 0.5 * d / sphere_radius / std::numbers::sqrt2;
      if (d >= 0.499f) continue;
      ++neighbours;
      EXPECT_NEAR(footprint_error(r, m * sphere_radius, m * side), expected, 1e-5);
    }
    EXPECT_GT(neighbours, 200);
  }
}

TEST(InFront, TheOtherSideOfAThinWallIsNeverServed) {
  RandomPlaces random(37);
  RecordCache cache(room);
  for (int i = 0; i < 500; ++i) cache.insert(round_record(random.point({0, 0, 1}, {4, 3, 1}), up, 0.5f, 0));
  for (int i = 0; i < 500; ++i) {
    for (const float thickness : {0.02f, 0.0f}) {
      EXPECT_FALSE(cache.covers(query(random.point({0, 0, 1 - thickness}, {4, 3, 1 - thickness}), {0, 0, -1})));
      const Vec3 slanted = normalize(Vec3{random.number(-1, 1), random.number(-1, 1), -0.2f});
      EXPECT_FALSE(cache.covers(query(random.point({0, 0, 1 - thickness}, {4, 3, 1 - thickness}), slanted)));
    }
    EXPECT_FALSE(cache.covers(query({random.number(0, 4), 0, 0.99f}, {0, -1, 0})));  // the wall's narrow edge
    EXPECT_TRUE(cache.covers(query(random.point({1, 1, 1}, {3, 2, 1}), up)));
  }
}

// A record on the upper tread sees past the step's edge what a point below it cannot; the other way round is no harm.
TEST(InFront, AStepDownIsRefusedBeyondAPartOfTheRadius) {
  const Record upper = round_record({1, 1, 0.5f}, up, 1, 1);
  EXPECT_EQ(footprint_error(upper, {1.3f, 1, 0.4f}, up), infinity);
  EXPECT_LT(footprint_error(upper, {1.3f, 1, 0.46f}, up), 1);
  EXPECT_LT(footprint_error(upper, {1.3f, 1, 0.6f}, up), 1);
  const Record small = round_record({1, 1, 0.5f}, up, 0.1f, 1);
  EXPECT_EQ(footprint_error(small, {1.03f, 1, 0.49f}, up), infinity);  // the same by scale
  EXPECT_LT(footprint_error(small, {1.03f, 1, 0.496f}, up), 1);
}

// Settling shrinks footprints under the index's feet: it goes on finding all, and building it anew changes no result.
TEST(RecordCache, SettlingAndReindexingKeepEveryResult) {
  RandomPlaces random(41);
  const RadiusBounds bounds{.neighbours = 1};
  RecordCache cache(room);
  for (int i = 0; i < 1500; ++i) {
    Record r = round_record(random.point({0, 0, 0}, {4, 3, 0}), random.direction_near(up, 0.2f), 1, 1);
    r.jet.value = random.colour(0, 1), r.jet.translational = random.gradient(1);
    r.jet.distances.harmonic_mean = std::pow(10.0f, random.number(-1, 1));
    r.footprint = bounded_split_sphere(r.jet, {.pixel = 0, .scene_scale = 5}, 0.3f, bounds);
    r.footprint.order = 1;
    const std::uint32_t id = cache.insert(r);
    settle_bounded(cache.settling(), {&id, 1}, 0.3f, bounds);
  }
  RecordCache rebuilt = cache;
  rebuilt.reindex();
  std::size_t offered = 0, offered_rebuilt = 0;
  for (int i = 0; i < 2000; ++i) {
    const Query q = query(random.point({-0.1f, -0.1f, 0}, {4.1f, 3.1f, 0}), random.direction_near(up, 0.3f));
    const auto expected = interpolate_naively(cache.records(), q);
    expect_near(cache.interpolate(q), expected, 2e-5);
    expect_near(rebuilt.interpolate(q), expected, 2e-5);
    EXPECT_EQ(cache.covers(q), rebuilt.covers(q));
    cache.visit_near(q.position, [&](const Record&) { ++offered; });
    rebuilt.visit_near(q.position, [&](const Record&) { ++offered_rebuilt; });
  }
  EXPECT_LT(offered_rebuilt, offered);
}

}  // namespace
}  // namespace isophote::test
