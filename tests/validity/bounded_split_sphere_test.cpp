#include "isophote/validity/bounded_split_sphere.h"

#include <gtest/gtest.h>

#include <numeric>

#include "isophote/validity/limit_extrapolation.h"
#include "isophote/validity/split_sphere.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float a = 0.25f;
constexpr View view{.pixel = 0.01f, .scene_scale = 10};

float radius(const Jet<Rgb>& jet, const RadiusBounds& bounds, const View& v = view) {
  return bounded_split_sphere(jet, v, a, bounds).radius;
}

TEST(BoundedSplitSphere, WithoutBoundsIsSplitSphereWithATent) {
  const Footprint bounded = bounded_split_sphere(jet_of(2), view, a, {});
  const Footprint plain = split_sphere(jet_of(2).distances, view, a);
  EXPECT_FLOAT_EQ(bounded.radius, plain.radius);
  EXPECT_FLOAT_EQ(bounded.shape.xx, plain.shape.xx);
  EXPECT_EQ(bounded.normal_scale, plain.normal_scale);
  EXPECT_EQ(bounded.unscaled, plain.unscaled);
  EXPECT_EQ(bounded.falloff, Falloff::tent);
}

TEST(BoundedSplitSphere, EachBoundAlone) {
  const Jet<Rgb> jet = jet_of(2);
  const float natural = split_sphere_radius(2, a);  // 0.39, 39 pixels
  EXPECT_FLOAT_EQ(radius(jet, {.min_pixels = 50}), 0.5f);
  EXPECT_FLOAT_EQ(radius(jet, {.min_pixels = 30}), natural);
  EXPECT_FLOAT_EQ(radius(jet, {.max_pixels = 30}), 0.3f);
  EXPECT_FLOAT_EQ(radius(jet, {.max_pixels = 50}), natural);
  const View picture{.pixel = 0.01f, .picture = 8, .scene_scale = 10};
  EXPECT_FLOAT_EQ(radius(jet, {.min_view = 0.5f}, picture), 0.5f * a * 8);
  EXPECT_FLOAT_EQ(radius(jet, {.min_view = 0.01f}, picture), natural);
  EXPECT_FLOAT_EQ(radius(jet, {.max_pixels = 60, .min_view = 0.5f}, picture), 0.6f);  // the upper bound in pixels wins
  EXPECT_FLOAT_EQ(radius(jet, {.max_view = 0.005f}, picture), 0.005f * 8);
  EXPECT_FLOAT_EQ(radius(jet, {.min_view = 0.5f, .max_view = 0.005f}, picture), 0.5f * a * 8);  // the lower bound wins
  EXPECT_FLOAT_EQ(radius(jet, {.max_view = 0.5f}, picture), natural);
  EXPECT_FLOAT_EQ(radius(jet, {.min_length = 0.7f}), 0.7f);
  EXPECT_FLOAT_EQ(radius(jet, {.min_length = 0.1f}), natural);
  EXPECT_FLOAT_EQ(radius(jet, {.max_length = 0.1f}), 0.1f);
  EXPECT_FLOAT_EQ(radius(jet, {.max_length = 0.7f}), natural);
}

// R <= E / |grad E| in the channel that changes most for its brightness, before a scales it.
TEST(BoundedSplitSphere, BoundByTheGradient) {
  const Gradient<Rgb> g{{0.3f, 0, 0}, {0.4f, 0, 0.2f}, {0, 0, 0}};
  const RadiusBounds bounds{.gradient = true};
  EXPECT_FLOAT_EQ(bounded_split_sphere(jet_of(8, Rgb(1, 1, 1), g), view, a, bounds).unscaled, 2);
  EXPECT_FLOAT_EQ(bounded_split_sphere(jet_of(8, Rgb(1, 1, 0.1f), g), view, a, bounds).unscaled, 0.5f);
  EXPECT_FLOAT_EQ(bounded_split_sphere(jet_of(1, Rgb(1, 1, 1), g), view, a, bounds).unscaled, 1);
  EXPECT_FLOAT_EQ(bounded_split_sphere(jet_of(8, Rgb(1, 1, 1), g), view, a, {}).unscaled, 8);
  EXPECT_FLOAT_EQ(radius(jet_of(8, Rgb(1, 1, 1), g), bounds), split_sphere_radius(2, a));
  EXPECT_FLOAT_EQ(radius(jet_of(8), bounds), split_sphere_radius(8, a));  // nothing changes, nothing to bound
}

// Pixels over scene units, lower over upper, and all of them over the gradient.
TEST(BoundedSplitSphere, Precedence) {
  const Jet<Rgb> jet = jet_of(2);
  EXPECT_FLOAT_EQ(radius(jet, {.max_pixels = 20, .min_length = 0.7f}), 0.2f);
  EXPECT_FLOAT_EQ(radius(jet, {.min_pixels = 50, .max_length = 0.1f}), 0.5f);
  EXPECT_FLOAT_EQ(radius(jet, {.min_pixels = 50, .max_pixels = 20}), 0.5f);
  EXPECT_FLOAT_EQ(radius(jet, {.min_length = 0.7f, .max_length = 0.1f}), 0.7f);
  const Jet<Rgb> steep = jet_of(2, Rgb(1), {Rgb(100), Rgb(), Rgb()});
  EXPECT_FLOAT_EQ(radius(steep, {.min_pixels = 1.5f, .gradient = true}), 0.015f);
  // Whatever is asked, no footprint is larger than the scene unless a pixel is.
  EXPECT_FLOAT_EQ(bounded_split_sphere(jet_of(infinite), view, 100, {}).radius, view.scene_scale);
}

TEST(BoundedSplitSphere, BlackAndOpenPlacesAndNoPixelsGivePositiveFootprints) {
  const RadiusBounds every{.min_pixels = 1.5f, .max_pixels = 20, .gradient = true, .neighbours = 1};
  const Gradient<Rgb> steep{Rgb(1), Rgb(), Rgb()};
  for (const View& v : {view, View{.pixel = 0, .scene_scale = 10}})
    for (const RadiusBounds& bounds : {RadiusBounds{}, RadiusBounds{.gradient = true}, every})
      for (const Jet<Rgb>& jet : {jet_of(infinite), jet_of(infinite, Rgb()), jet_of(1, Rgb()), jet_of(1, Rgb(), steep),
                                  jet_of(1e-6f, Rgb(1), steep)}) {
        const Footprint f = bounded_split_sphere(jet, v, a, bounds);
        EXPECT_TRUE(std::isfinite(f.radius) && f.radius > 0);
        EXPECT_TRUE(std::isfinite(f.shape.xx) && f.shape.xx > 0);
        EXPECT_TRUE(std::isfinite(f.unscaled) && f.unscaled >= 0);
        EXPECT_NEAR(f.shape.xx * f.radius * f.radius, 1, 1e-5);
        Record record = round_record({}, {0, 0, 1}, 1);
        record.jet = jet;
        record.footprint = f;
        const std::uint32_t fresh = 0;
        NeighbourIndex neighbours({{}, {}});
        settle_bounded({{&record, 1}, neighbours}, {&fresh, 1}, a, bounds);
        EXPECT_TRUE(record.gradient_scale >= 0 && record.gradient_scale <= 1);
      }
}

std::vector<Record> scattered(int count, float normal_spread, const RadiusBounds& bounds) {
  RandomPlaces random(7);
  std::vector<Record> records;
  for (int i = 0; i < count; ++i) {
    Record r = round_record(random.point({0, 0, 0}, {4, 4, 1}), random.direction_near({0, 0, 1}, normal_spread), 1);
    r.jet = jet_of(std::pow(10.0f, random.number(-1.5f, 1)), random.colour(0.1f, 2), random.gradient(1));
    r.footprint = bounded_split_sphere(r.jet, view, a, bounds);
    records.push_back(r);
  }
  return records;
}
/// Inserts and settles them in batches, as rounds do.
void settle_in_batches(std::vector<Record>& records, std::size_t batch, const RadiusBounds& bounds) {
  NeighbourIndex neighbours({{0, 0, 0}, {4, 4, 1}});
  for (std::size_t begin = 0; begin < records.size(); begin += batch) {
    const std::size_t end = std::min(records.size(), begin + batch);
    std::vector<std::uint32_t> fresh(end - begin);
    std::iota(fresh.begin(), fresh.end(), static_cast<std::uint32_t>(begin));
    settle_bounded({std::span(records).first(end), neighbours}, fresh, a, bounds);
  }
}

// Among records that all face alike the outcome is the minimum over all of R_j + |x_i - x_j|: the bound holds for every
// pair, no radius grew, none shrank more than it must, and neither order nor batches matter.
TEST(NeighbourClamping, IsTheLargestLipschitzRadii) {
  const RadiusBounds bounds{.neighbours = 1};
  const std::vector<Record> before = scattered(300, 0.5f, bounds);
  for (const bool reversed : {false, true})
    for (const std::size_t batch : {1, 37, 300}) {
      std::vector<Record> records = before;
      if (reversed) std::reverse(records.begin(), records.end());
      settle_in_batches(records, batch, bounds);
      if (reversed) std::reverse(records.begin(), records.end());
      int shrunk = 0;
      for (std::size_t i = 0; i < records.size(); ++i) {
        float expected = before[i].footprint.unscaled;
        for (const Record& other : before) {
          ASSERT_GT(dot(other.normal, before[i].normal), 0);
          expected = std::min(expected, other.footprint.unscaled + length(other.position - before[i].position));
        }
        EXPECT_NEAR(records[i].footprint.unscaled, expected, 1e-5f * expected);
        EXPECT_LE(records[i].footprint.unscaled, before[i].footprint.unscaled);
        EXPECT_NEAR(records[i].footprint.radius, split_sphere_radius(records[i].footprint.unscaled, a), 1e-6f);
        shrunk += records[i].footprint.unscaled < before[i].footprint.unscaled;
      }
      EXPECT_GT(shrunk, 100);
      EXPECT_LT(shrunk, 300);
    }
}

// With normals all round, a pair is held to the bound from the moment the later one is settled.
TEST(NeighbourClamping, FreshRecordsAndTheirNeighboursKeepTheBound) {
  const RadiusBounds bounds{.neighbours = 1};
  const std::vector<Record> before = scattered(200, 100, bounds);
  std::vector<Record> records = before;
  NeighbourIndex neighbours({{0, 0, 0}, {4, 4, 1}});
  for (std::uint32_t i = 0; i < records.size(); ++i) {
    settle_bounded({std::span(records).first(i + 1), neighbours}, {&i, 1}, a, bounds);
    for (std::uint32_t j = 0; j < i; ++j) {
      if (dot(records[i].normal, records[j].normal) <= 0) continue;
      const float distance = length(records[i].position - records[j].position);
      EXPECT_LE(std::abs(records[i].footprint.unscaled - records[j].footprint.unscaled), distance * 1.00001f + 1e-6f);
    }
  }
  for (std::size_t i = 0; i < records.size(); ++i)
    EXPECT_LE(records[i].footprint.unscaled, before[i].footprint.unscaled);
}

TEST(NeighbourClamping, LeavesRecordsThatFaceAwayAndWhoeverDidNotAsk) {
  std::vector<Record> back_to_back{round_record({0, 0, 0}, {0, 0, 1}, 1),
                                   round_record({0.1f, 0, 0}, {0, 0, -1}, 0.01f)};
  settle_in_batches(back_to_back, 1, {.neighbours = 1});
  EXPECT_EQ(back_to_back[0].footprint.unscaled, 1);
  std::vector<Record> alike = back_to_back;
  alike[1].normal = {0, 0, 1};
  settle_in_batches(alike, 1, {});
  EXPECT_EQ(alike[0].footprint.unscaled, 1);
  settle_in_batches(alike, 1, {.neighbours = 1});
  EXPECT_FLOAT_EQ(alike[0].footprint.unscaled, 0.11f);
}

TEST(NeighbourClamping, KeepsTheLowerBoundAndTheLimitOnGradients) {
  const RadiusBounds bounds{.min_pixels = 10, .neighbours = 1};
  std::vector<Record> records = scattered(200, 0.5f, bounds);
  settle_in_batches(records, 20, bounds);
  for (const Record& r : records) {
    const float lowest = 10 * view.pixel;
    EXPECT_GE(r.footprint.radius, lowest);
    EXPECT_FLOAT_EQ(r.footprint.radius, std::max(lowest, split_sphere_radius(r.footprint.unscaled, a)));
    Record anew = r;  // the limit on extrapolation is that of the final radius, whoever changed it last
    limit_extrapolation(anew, r.footprint.unscaled * split_sphere_radius(1, a));
    EXPECT_EQ(r.gradient_scale, anew.gradient_scale);
  }
}

// A floor under the radius widens a record along its surface only: a step up, as from a floor to a table, is as far as
// the metric alone has it.
TEST(RaisedRadius, ReachesAlongTheSurfaceOnly) {
  for (const float harmonic_mean : {0.8f, 0.01f}) {
    Record r = round_record({1, 2, 3}, {0, 0.6f, 0.8f}, 1);
    r.jet = jet_of(harmonic_mean);
    const RadiusBounds bounds{.min_length = 0.4f};
    r.footprint = bounded_split_sphere(r.jet, view, a, bounds);
    NeighbourIndex neighbours({{}, {}});
    const std::uint32_t fresh = 0;
    settle_bounded({{&r, 1}, neighbours}, {&fresh, 1}, a, bounds);
    const float natural = split_sphere_radius(harmonic_mean, a);
    ASSERT_LT(natural, 0.4f);
    const auto reach = [&](const Vec3& d) { return 1 / std::sqrt(quadratic_form(r.footprint.shape, d)); };
    EXPECT_FLOAT_EQ(r.footprint.radius, 0.4f);
    EXPECT_NEAR(reach({1, 0, 0}), 0.4f, 1e-6);
    EXPECT_NEAR(reach({0, 0.8f, -0.6f}), 0.4f, 1e-6);
    EXPECT_NEAR(reach({0, 0.6f, 0.8f}), std::max(natural, 0.1f), 1e-6);  // a quarter of the radius is left for bumps
  }
}

// Nothing here has a unit of length: with the scene scaled by a power of two, everything scales exactly.
TEST(BoundedSplitSphere, ScalesExactly) {
  for (const float s : {0x1p-10f, 0x1p13f}) {
    RadiusBounds bounds{.min_pixels = 1.5f,
                        .max_pixels = 20,
                        .min_length = 0.03f,
                        .max_length = 0.6f,
                        .gradient = true,
                        .neighbours = 1};
    std::vector<Record> unit = scattered(200, 2, bounds), scaled = unit;
    const View far_view{.pixel = view.pixel * s, .scene_scale = view.scene_scale * s};
    RadiusBounds far_bounds = bounds;
    far_bounds.min_length *= s, far_bounds.max_length *= s;
    for (Record& r : scaled) {
      r.position *= s;
      r.jet.distances.harmonic_mean *= s;
      for (Rgb* g : {&r.jet.translational.x, &r.jet.translational.y, &r.jet.translational.z}) *g *= 1 / s;
      r.footprint = bounded_split_sphere(r.jet, far_view, a, far_bounds);
    }
    settle_in_batches(unit, 16, bounds);
    settle_in_batches(scaled, 16, far_bounds);
    for (std::size_t i = 0; i < unit.size(); ++i) {
      EXPECT_EQ(scaled[i].footprint.radius, unit[i].footprint.radius * s);
      EXPECT_EQ(scaled[i].footprint.unscaled, unit[i].footprint.unscaled * s);
      EXPECT_EQ(scaled[i].footprint.shape.xx * s * s, unit[i].footprint.shape.xx);
      EXPECT_EQ(scaled[i].gradient_scale, unit[i].gradient_scale);
    }
  }
}

}  // namespace
}  // namespace isophote::test
