#include "isophote/cache/volume_cache.h"

#include <gtest/gtest.h>

#include "isophote/core/ray.h"
#include "support/records.h"
#include "support/volume_records.h"

namespace isophote::test {
namespace {

constexpr Box room{{0, 0, 0}, {4, 3, 2.5f}};
constexpr Vec3 eye{0, 0, 1};

/// Seen by a phase function that scatters evenly.
std::optional<Rgb> evenly(const VolumeCache& cache, const VolumeQuery& query, VolumeOpenTest open = {}) {
  return cache.scattered(query, phase_lobe(0, eye, 1), 1, open);
}

/// Records of every kind all over the room: balls and ellipsoids, in logarithms or not, in three media, of one to three
/// bands, with a gradient or none.
std::vector<VolumeRecord> many_records(int count, RandomPlaces& random) {
  std::vector<VolumeRecord> records;
  for (int i = 0; i < count; ++i) {
    VolumeRecord r =
        volume_record(random.point(room.lower, room.upper), random.number(0.05f, 0.7f), {}, 1 + (i % 7) / 3);
    r.footprint.shape.yy *= random.number(1, 4);
    r.footprint.falloff = i % 5 == 0 ? Falloff::tent : Falloff::smooth;
    r.footprint.order = i % 4 ? 1 : 0;
    r.footprint.logarithmic = i % 2;
    r.gradient_scale = random.number(0, 1);
    r.jet.value.clear();
    const int bands = 1 + i % 3;
    for (int k = 0; k < bands * bands; ++k) r.jet.value.push_back(random.colour(k == 0 ? 2 : -0.5f, k == 0 ? 4 : 0.5f));
    if (i % 4 != 1)
      for (Coefficients* all : {&r.jet.translational.x, &r.jet.translational.y, &r.jet.translational.z})
        for (int k = 0; k < bands * bands; ++k) all->push_back(random.colour(-3, 3));
    records.push_back(r);
  }
  return records;
}

/// The sum over all records, in doubles.
std::optional<Rgbd> scattered_naively(std::span<const VolumeRecord> records, const VolumeQuery& q,
                                      const PhaseLobe& lobe, int order) {
  Rgbd result;
  double weights = 0;
  for (int c = 0; c < 3; ++c) {
    double logarithms = 0, in_logarithms = 0, values = 0, others = 0;
    for (const VolumeRecord& r : records) {
      const Vec3d d(q.position - r.position);
      const double t = std::sqrt(quadratic_form(Sym3d(r.footprint.shape), d));
      if (r.media != q.media || t >= 1 || VolumeCache::bands(r) < order) continue;
      const double weight =
          r.footprint.falloff == Falloff::tent ? 1 - t : 3 * (1 - t) * (1 - t) - 2 * std::pow(1 - t, 3);
      double value = 0, change = 0;
      for (int k = 0; k < order * order; ++k) {
        value += double{lobe[k]} * r.jet.value[k][c];
        const auto& g = r.jet.translational;
        if (r.footprint.order > 0 && !g.x.empty())
          change += double{lobe[k]} * (g.x[k][c] * d.x + g.y[k][c] * d.y + g.z[k][c] * d.z) * r.gradient_scale;
      }
      if (r.footprint.logarithmic)
        logarithms += weight * (std::log(value) + std::clamp(change / value, -2.0, 2.0)), in_logarithms += weight;
      else
        values += weight * (value + change), others += weight;
    }
    weights = in_logarithms + others;
    const double geometric = in_logarithms > 0 ? in_logarithms * std::exp(logarithms / in_logarithms) : 0;
    result[c] = std::max(0.0, (geometric + values) / weights);
  }
  if (weights == 0) return std::nullopt;
  return result;
}

TEST(VolumeCache, IsASumOverAllRecords) {
  RandomPlaces random(11);
  const std::vector<VolumeRecord> records = many_records(3000, random);
  VolumeCache cache(room);
  for (const VolumeRecord& r : records) cache.insert(r);
  int served = 0;
  for (int i = 0; i < 3000; ++i) {
    const VolumeQuery q{random.point(room.lower, room.upper), 1 + static_cast<std::uint32_t>(i % 4)};
    const int order = 1 + i % 3;
    const PhaseLobe lobe = phase_lobe(0.4f, random.direction(), order);
    const auto value = cache.scattered(q, lobe, order);
    const auto expected = scattered_naively(records, q, lobe, order);
    ASSERT_EQ(value.has_value(), expected.has_value());
    EXPECT_EQ(cache.covers(q, order), value.has_value());
    EXPECT_TRUE(q.media < 4 || !value);
    for (int c = 0; value && c < 3; ++c) EXPECT_NEAR((*value)[c], (*expected)[c], 1e-5);
    served += value.has_value();
  }
  EXPECT_GT(served, 1500);
  EXPECT_LT(served, 2250);
}

// L = exp(k . x) is reproduced exactly by logarithms, by any number of records; linearly it is not.
TEST(VolumeCache, LogarithmsAreExactOfExponentialDecay) {
  RandomPlaces random(5);
  const Vec3 k{-0.8f, 0.5f, 0.3f};
  VolumeCache in_logarithms(room), linear(room);
  for (int i = 0; i < 400; ++i) {
    VolumeRecord r = volume_record(random.point(room.lower, room.upper), random.number(0.4f, 0.8f));
    const float value = std::exp(dot(k, r.position));
    r.jet.value = even_radiance(Rgb(value));
    set_slope(r, {Rgb(k.x * value), Rgb(k.y * value), Rgb(k.z * value)});
    linear.insert(r);
    r.footprint.logarithmic = true;
    in_logarithms.insert(r);
  }
  double error = 0, linear_error = 0;
  int served = 0;
  for (int i = 0; i < 1000; ++i) {
    const VolumeQuery q{random.point(room.lower, room.upper), 1};
    if (!in_logarithms.covers(q, 1)) continue;
    const double truth = std::exp(dot(k, q.position));
    error = std::max(error, std::abs(evenly(in_logarithms, q)->g / truth - 1));
    linear_error = std::max(linear_error, std::abs(evenly(linear, q)->g / truth - 1));
    ++served;
  }
  EXPECT_GT(served, 900);
  EXPECT_LT(error, 2e-6);
  EXPECT_GT(linear_error, 0.01);
}

TEST(VolumeCache, LinearFieldsAreExactWithoutLogarithms) {
  RandomPlaces random(6);
  VolumeCache cache(room);
  const auto truth = [](const Vec3& p) { return Rgb(1 + 0.2f * p.x, 2 - 0.3f * p.y, 1 + 0.1f * p.z + 0.1f * p.x); };
  for (int i = 0; i < 400; ++i) {
    VolumeRecord r = volume_record(random.point(room.lower, room.upper), random.number(0.4f, 0.8f));
    r.jet.value = even_radiance(truth(r.position));
    set_slope(r, {{0.2f, 0, 0.1f}, {0, -0.3f, 0}, {0, 0, 0.1f}});
    cache.insert(r);
  }
  int served = 0;
  for (int i = 0; i < 500; ++i) {
    const VolumeQuery q{random.point(room.lower, room.upper), 1};
    const auto value = evenly(cache, q);
    for (int c = 0; value && c < 3; ++c) EXPECT_NEAR((*value)[c], truth(q.position)[c], 3e-6);
    served += value.has_value();
  }
  EXPECT_GT(served, 450);
}

// exp(2) at most is what an extrapolation makes of a value, and 0 at least.
TEST(VolumeCache, ExtrapolationHasItsLimits) {
  for (const float steep : {1e3f, -1e3f}) {
    VolumeRecord r = volume_record({1, 1, 1}, 1);
    set_slope(r, {Rgb(steep), {}, {}});
    VolumeCache linear(room), in_logarithms(room);
    linear.insert(r);
    r.footprint.logarithmic = true;
    in_logarithms.insert(r);
    const VolumeQuery q{{1.5f, 1, 1}, 1};
    EXPECT_NEAR(evenly(in_logarithms, q)->r, std::exp(steep > 0 ? 2.0 : -2.0), 1e-5);
    EXPECT_NEAR(evenly(linear, q)->r, steep > 0 ? 501 : 0, 1e-3);
    EXPECT_FLOAT_EQ(evenly(in_logarithms, {{1, 1, 1}, 1})->r, 1);
  }
}

// A channel that holds next to nothing counts as it is; its logarithm would outweigh all others.
TEST(VolumeCache, BlackChannelsAreNotTakenInLogarithms) {
  VolumeCache cache(room);
  for (const Rgb& mean : {Rgb(1, 1, 1), Rgb(1, 0, 1e-7f)}) {
    VolumeRecord r = volume_record({1, 1, 1}, 1, mean);
    r.footprint.logarithmic = true;
    cache.insert(r);
  }
  const Rgb value = *evenly(cache, {{1.2f, 1, 1}, 1});
  EXPECT_FLOAT_EQ(value.r, 1);
  EXPECT_FLOAT_EQ(value.g, 0.5f);
  EXPECT_FLOAT_EQ(value.b, 0.5f);
  VolumeCache dark(room);
  VolumeRecord r = volume_record({1, 1, 1}, 1, {});
  r.footprint.logarithmic = true;
  dark.insert(r);
  EXPECT_EQ(evenly(dark, {{1.2f, 1, 1}, 1}), Rgb());
}

TEST(VolumeCache, OnlyTheSameMediaAreServed) {
  VolumeCache cache(room);
  cache.insert(volume_record({1, 1, 1}, 1, Rgb(2), 1));
  cache.insert(volume_record({1, 1, 1}, 1, Rgb(3), 3));
  cache.insert(volume_record({1, 1, 1}, 1, Rgb(4), 0));
  EXPECT_FLOAT_EQ(evenly(cache, {{1.1f, 1, 1}, 1})->r, 2);
  EXPECT_FLOAT_EQ(evenly(cache, {{1.1f, 1, 1}, 3})->r, 3);
  EXPECT_FLOAT_EQ(evenly(cache, {{1.1f, 1, 1}, 0})->r, 4);
  EXPECT_FALSE(evenly(cache, {{1.1f, 1, 1}, 2}));
  EXPECT_FALSE(cache.covers({{1.1f, 1, 1}, 2}, 1));
}

TEST(VolumeCache, AsksWhatStandsBetweenOnlyBeyondWhatWasSeen) {
  VolumeCache cache(room);
  VolumeRecord near = volume_record({1, 1, 1}, 1, Rgb(5));
  for (int i = 0; i < ObstaclesAround::sectors; ++i) near.jet.obstacles.meet(i, 0.5f);
  cache.insert(near);
  cache.insert(volume_record({1, 1.5f, 1}, 1, Rgb(1)));  // saw nothing near
  int asked = 0, expected = 0;
  const auto closed = [&](const Site& record, const VolumeQuery&) {
    EXPECT_EQ(record.position, near.position);
    return ++asked, false;
  };
  RandomPlaces random(53);
  for (int i = 0; i < 300; ++i) {
    const VolumeQuery q{random.point({0, 0, 0.5f}, {2, 2, 1.5f}), 1};
    const float distance = length(q.position - near.position);
    if (std::abs(distance - 0.4f) < 0.01f || std::abs(distance - 1) < 1e-5f) continue;
    const bool unsure = distance > 0.4f && distance < 1;
    expected += unsure;
    const auto value = evenly(cache, q, closed);
    EXPECT_EQ(asked, expected);
    const bool other = length(q.position - Vec3{1, 1.5f, 1}) < 1;
    EXPECT_EQ(value.has_value(), other || distance < 0.4f);
    if (value && unsure) {
      EXPECT_FLOAT_EQ(value->r, 1);
    }
    EXPECT_EQ(cache.covers(q, 1), other || distance < 1);
  }
  EXPECT_GT(asked, 50);
}

TEST(VolumeCache, RecordsOfTooFewBandsDoNotServe) {
  VolumeCache cache(room);
  VolumeRecord r = volume_record({1, 1, 1}, 1);
  r.jet.value.resize(9);
  cache.insert(r);
  const PhaseLobe lobe = phase_lobe(0.3f, eye, 4);
  EXPECT_TRUE(cache.covers({{1, 1, 1}, 1}, 3));
  EXPECT_FALSE(cache.covers({{1, 1, 1}, 1}, 4));
  EXPECT_TRUE(cache.scattered({{1, 1, 1}, 1}, lobe, 3));
  EXPECT_FALSE(cache.scattered({{1, 1, 1}, 1}, lobe, 4));
}

TEST(VolumeCache, SmoothFalloff) {
  EXPECT_EQ(falloff_weight(Falloff::smooth, 0), 1);
  EXPECT_FLOAT_EQ(falloff_weight(Falloff::smooth, 0.5f), 0.5f);
  EXPECT_FLOAT_EQ(falloff_weight(Falloff::smooth, 0.25f), 3 * 0.5625f - 2 * 0.421875f);
  const float last = 0x1.fffffep-1f;  // every record that covers counts
  EXPECT_GT(falloff_weight(Falloff::smooth, last), 0);
  for (float t = 0; t < 0.99f; t += 0.01f)
    EXPECT_GE(falloff_weight(Falloff::smooth, t), falloff_weight(Falloff::smooth, t + 0.01f));
  VolumeCache cache(room);
  VolumeRecord r = volume_record({1, 1, 1}, 0.5f, Rgb(2));
  cache.insert(r);
  EXPECT_FLOAT_EQ(evenly(cache, {{1.49999f, 1, 1}, 1})->r, 2);
}

// Nothing depends on the units of length and light.
TEST(VolumeCache, ScalesExactly) {
  for (const float s : {0x1p-10f, 0x1p13f}) {
    RandomPlaces random(71);
    VolumeCache cache(room), scaled(Box{room.lower * s, room.upper * s});
    for (VolumeRecord& r : many_records(500, random)) {
      cache.insert(r);
      r.position *= s;
      r.footprint.radius *= s;
      r.footprint.shape = r.footprint.shape * (1 / (s * s));
      for (Rgb& c : r.jet.value) c *= s * s;
      for (Coefficients* all : {&r.jet.translational.x, &r.jet.translational.y, &r.jet.translational.z})
        for (Rgb& c : *all) c *= s;
      scaled.insert(r);
    }
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random.point(room.lower, room.upper);
      const PhaseLobe lobe = phase_lobe(-0.3f, random.direction(), 2);
      const auto a = cache.scattered({p, 1}, lobe, 2), b = scaled.scattered({p * s, 1}, lobe, 2);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_EQ(*a * (s * s), *b);
      }
    }
  }
}

TEST(VolumeCache, KnowsItsMean) {
  VolumeCaches caches(room);
  EXPECT_EQ(caches.surfaces.mean(), 0);
  caches.of(VolumePart::surfaces).insert(volume_record({1, 1, 1}, 1, Rgb(2)));
  caches.of(VolumePart::surfaces).insert(volume_record({1, 1, 1}, 1, Rgb(4)));
  EXPECT_NEAR(caches.surfaces.mean(), 3, 1e-6);
  EXPECT_EQ(caches.media.records().size(), 0u);
  RecordCache cache(room);
  EXPECT_EQ(cache.volumes(), nullptr);
  cache.set_volumes(std::make_shared<VolumeCaches>(caches));
  EXPECT_EQ(RecordCache(cache).volumes()->surfaces.records().size(), 2u);
}

}  // namespace
}  // namespace isophote::test
