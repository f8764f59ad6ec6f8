#include "isophote/validity/relative_change.h"

#include <gtest/gtest.h>

#include <numeric>

#include "isophote/validity/gradient_radius.h"
#include "isophote/validity/limit_extrapolation.h"
#include "isophote/validity/settle.h"
#include "isophote/validity/uniform.h"
#include "support/records.h"
#include "support/volume_records.h"

namespace isophote::test {
namespace {

constexpr View view{.pixel = 0.01f, .scene_scale = 10};

VolumeJet jet_of_sums(float value, float gradient) {
  VolumeJet jet = volume_record({}, 1).jet;
  jet.value_sum = value, jet.gradient_sum = gradient;
  return jet;
}

TEST(RelativeChange, IsThePublishedRadius) {
  const Footprint f = relative_change(jet_of_sums(3, 2), view, 0.2f, {});
  EXPECT_FLOAT_EQ(f.radius, 0.3f);
  EXPECT_FLOAT_EQ(f.unscaled, 1.5f);
  EXPECT_FLOAT_EQ(quadratic_form(f.shape, Vec3{0.1f, -0.2f, 0.2f}), 1);
  EXPECT_EQ(f.falloff, Falloff::smooth);
  EXPECT_EQ(f.normal_scale, 0);
}

TEST(RelativeChange, BoundsAndPlacesOfNoLight) {
  EXPECT_FLOAT_EQ(relative_change(jet_of_sums(0, 0), view, 0.2f, {}).radius, 2);
  EXPECT_FLOAT_EQ(relative_change(jet_of_sums(1, 0), view, 0.2f, {}).radius, 2);
  EXPECT_FLOAT_EQ(relative_change(jet_of_sums(0, 1), view, 0.2f, {}).radius, 10 * smallest_radius);
  EXPECT_FLOAT_EQ(relative_change(jet_of_sums(3, 2), view, 0.2f, {.min_pixels = 50}).radius, 0.5f);
  EXPECT_FLOAT_EQ(relative_change(jet_of_sums(3, 2), view, 0.2f, {.max_pixels = 20}).radius, 0.2f);
  EXPECT_FLOAT_EQ(
      relative_change(jet_of_sums(3, 2), {.picture = 2, .scene_scale = 10}, 0.2f, {.max_view = 0.05f}).radius, 0.1f);
}

// Where lights of all sides cancel, the net gradient says nothing, and where an edge moves the samples' own do not.
TEST(RelativeChange, TheGradientBoundsTheLength) {
  VolumeRecord r = volume_record({}, 1, Rgb(2, 2, 1));
  r.jet.value_sum = 2, r.jet.gradient_sum = 1;
  set_slope(r, {{0, 0, 3}, {}, {4, 0, 0}});
  EXPECT_FLOAT_EQ(gradient_radius(r.jet), 1.0f / 3);
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 0.2f, {}).unscaled, 2);
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 0.2f, {.gradient = true}).unscaled, 1.0f / 3);
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 4, {}).radius, 1.0f / 3);  // above 1 in any case
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 4, {.min_pixels = 50}).radius, 0.5f);
  set_slope(r, {});
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 0.2f, {.gradient = true}).unscaled, 2);
  EXPECT_FLOAT_EQ(relative_change(r.jet, view, 4, {}).radius, 8);
}

TEST(Uniform, InMediaIsOneBall) {
  const Footprint f = uniform_in_media({.pixel = 0.01f, .scene_scale = 5}, 0.3f);
  EXPECT_FLOAT_EQ(f.radius, 0.15f);
  EXPECT_FLOAT_EQ(f.unscaled, 0.15f);
  EXPECT_EQ(f.falloff, Falloff::smooth);
}

// |grad L| R <= L in every channel that counts, of all coefficients together; gentler gradients stay whole.
TEST(LimitExtrapolation, InMedia) {
  RandomPlaces random(3);
  int limited = 0, whole = 0;
  for (int i = 0; i < 500; ++i) {
    VolumeRecord r = volume_record({}, random.number(0.1f, 2));
    auto& [x, y, z] = r.jet.translational;
    r.jet.value.clear();
    for (int k = 0; k < 4; ++k) {
      r.jet.value.push_back(random.colour(k == 0 ? 0 : -1, 1));
      x.push_back(random.colour(-1, 1)), y.push_back(random.colour(-1, 1)), z.push_back(random.colour(-1, 1));
    }
    limit_extrapolation(r);
    double most = 0;
    Rgb size, slope;
    for (int k = 0; k < 4; ++k)
      size += r.jet.value[k] * r.jet.value[k], slope += x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
    const Rgb root{std::sqrt(size.r), std::sqrt(size.g), std::sqrt(size.b)};
    for (int c = 0; c < 3; ++c)
      most =
          std::max(most, std::sqrt(double{slope[c]}) * r.footprint.radius / std::max(root[c], 0.05f * luminance(root)));
    EXPECT_NEAR(r.gradient_scale, std::min(1.0, 1 / most), 1e-5);
    ++(r.gradient_scale < 1 ? limited : whole);
  }
  EXPECT_GT(limited, 50);
  EXPECT_GT(whole, 50);
  VolumeRecord flat = volume_record({}, 2);  // thin along x, where the gradient is steep
  flat.footprint.flatten({1, 0, 0}, 0.1f);
  set_slope(flat, {Rgb(8), Rgb(0.1f), {}});
  limit_extrapolation(flat);
  EXPECT_EQ(flat.gradient_scale, 1);
  set_slope(flat, {Rgb(8), Rgb(1), {}});
  limit_extrapolation(flat);
  EXPECT_FLOAT_EQ(flat.gradient_scale, 1 / std::sqrt(0.8f * 0.8f + 2 * 2));
  VolumeRecord value_alone = volume_record({}, 1);
  limit_extrapolation(value_alone);
  EXPECT_EQ(value_alone.gradient_scale, 1);
}

std::vector<VolumeRecord> scattered(int count, const RadiusBounds& bounds) {
  RandomPlaces random(7);
  std::vector<VolumeRecord> records;
  for (int i = 0; i < count; ++i) {
    VolumeRecord r = volume_record(random.point({0, 0, 0}, {4, 4, 4}), 1, random.colour(0.1f, 1), 1u << (i % 3));
    set_slope(r, random.gradient(3));
    r.jet.value_sum = 1, r.jet.gradient_sum = std::pow(10.0f, random.number(-1, 1.5f));
    r.footprint = relative_change(r.jet, view, 0.5f, bounds);
    records.push_back(r);
  }
  return records;
}

// The largest radii with |R_i - R_j| <= |x_i - x_j| on unscaled ones, none grown, in whatever batches they come, and
// the gradients limited by what became of the radius.
TEST(NeighbourClamping, InMedia) {
  const RadiusBounds bounds{.min_pixels = 1.5f};
  const std::vector<VolumeRecord> before = scattered(300, bounds);
  for (const std::size_t batch : {1, 37, 300}) {
    std::vector<VolumeRecord> records = before;
    NeighbourIndex neighbours({{0, 0, 0}, {4, 4, 4}});
    for (std::size_t begin = 0; begin < records.size(); begin += batch) {
      const std::size_t end = std::min(records.size(), begin + batch);
      std::vector<std::uint32_t> fresh(end - begin);
      std::iota(fresh.begin(), fresh.end(), static_cast<std::uint32_t>(begin));
      settle(SettlingOf<VolumeRecord>{std::span(records).first(end), neighbours}, fresh, {.scale = 0.5f, .slope = 1});
    }
    int shrunk = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
      float expected = before[i].footprint.unscaled;
      for (const VolumeRecord& other : before)
        expected = std::min(expected, other.footprint.unscaled + length(other.position - before[i].position));
      const Footprint& f = records[i].footprint;
      EXPECT_NEAR(f.unscaled, expected, 1e-5f * expected);
      EXPECT_NEAR(f.radius, std::max(0.5f * expected, 0.015f), 1e-5f * f.radius);
      EXPECT_NEAR(f.shape.xx * f.radius * f.radius, 1, 1e-4);
      EXPECT_NEAR(f.shape.zz * f.radius * f.radius, 1, 1e-4) << "there is no surface to flatten it to";
      VolumeRecord anew = records[i];
      limit_extrapolation(anew);
      EXPECT_EQ(records[i].gradient_scale, anew.gradient_scale);
      shrunk += f.unscaled < before[i].footprint.unscaled;
    }
    EXPECT_GT(shrunk, 50);
    EXPECT_LT(shrunk, 300);
  }
}

}  // namespace
}  // namespace isophote::test
