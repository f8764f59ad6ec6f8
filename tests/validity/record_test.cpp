#include <gtest/gtest.h>

#include "isophote/validity/limit_extrapolation.h"
#include "support/records.h"

namespace isophote::test {
namespace {

/// In parts of the value, for the channel that changes most; a channel of less than 5 % of the luminance counts as
/// that.
float change_over_footprint(const Record& r) {
  const auto& g = r.jet.translational;
  float most = 0;
  for (int c = 0; c < 3; ++c)
    most =
        std::max(most, length(Vec3{g.x[c], g.y[c], g.z[c]}) / std::max(r.jet.value[c], 0.05f * luminance(r.jet.value)));
  return most * r.footprint.radius * r.gradient_scale;
}

// Over a footprint no channel changes by more than its own value; a gentle gradient is left alone; and what the lower
// bound stretched by a factor loses that factor.
TEST(LimitExtrapolation, Invariants) {
  RandomPlaces random(3);
  int limited = 0, untouched = 0;
  for (int i = 0; i < 2000; ++i) {
    Record r = round_record({}, {0, 0, 1}, random.number(0.05f, 2));
    r.jet = jet_of(1, random.colour(0, 1), random.gradient(1));
    const float natural = r.footprint.radius * random.number(0.3f, 3);
    limit_extrapolation(r, natural);
    EXPECT_LE(change_over_footprint(r), 1.00001f);
    EXPECT_GE(r.gradient_scale, 0);
    EXPECT_LE(r.gradient_scale, std::min(1.0f, natural / r.footprint.radius));
    Record free = r;
    free.gradient_scale = 1;
    if (change_over_footprint(free) <= 1 && natural >= r.footprint.radius) {
      EXPECT_EQ(r.gradient_scale, 1);
      ++untouched;
    } else {
      EXPECT_LT(r.gradient_scale, 1);
      ++limited;
    }
    const float once = r.gradient_scale;
    limit_extrapolation(r, natural);
    EXPECT_EQ(r.gradient_scale, once);
  }
  EXPECT_GT(limited, 100);
  EXPECT_GT(untouched, 100);
}

TEST(LimitExtrapolation, BlackRecordsDoNotExtrapolate) {
  Record r = round_record({}, {0, 0, 1}, 1);
  r.jet = jet_of(1, Rgb(), {Rgb(1), Rgb(), Rgb()});
  r.footprint.order = 1;
  limit_extrapolation(r, 1);
  EXPECT_EQ(r.gradient_scale, 0);
  EXPECT_EQ(r.extrapolate({0.5f, 0, 0}, r.normal), Rgb());
}

// Anywhere in the footprint the second-order term is at most a quarter of the luminance; a gentle one is left alone.
TEST(LimitExtrapolation, BendsByNoMoreThanAQuarter) {
  RandomPlaces random(9);
  int limited = 0, untouched = 0;
  for (int i = 0; i < 1000; ++i) {
    Record r = round_record({}, {0, 0, 1}, random.number(0.05f, 2));
    r.jet = jet_of(1, random.colour(0.1f, 1));
    r.jet.hessian = {random.number(-1, 1), random.number(-1, 1), 0, random.number(-1, 1), 0, 0};
    r.footprint.order = 2;
    limit_extrapolation(r, r.footprint.radius);
    const float l = luminance(r.jet.value), angle = random.number(0, 6.28f);
    const Vec3 rim = Vec3{std::cos(angle), std::sin(angle), 0} * r.footprint.radius;
    const float bend = luminance(r.extrapolate(rim, r.normal) - r.jet.value);
    EXPECT_LE(std::abs(bend), 0.25001f * l);
    const bool whole = r.curvature_scale == 1 / (2 * l);
    if (whole) {
      EXPECT_NEAR(bend, quadratic_form(r.jet.hessian, rim) / 2, 1e-5f);
    }
    whole ? ++untouched : ++limited;
  }
  EXPECT_GT(limited, 100);
  EXPECT_GT(untouched, 100);
}

TEST(Record, ExtrapolatesByItsOrderAndNeverBelowZero) {
  Record r = round_record({}, {0, 0, 1}, 1);
  r.jet.value = {1, 2, 3};
  r.jet.translational = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  r.jet.rotational.x = {0.5f, 0, 0};
  r.gradient_scale = 0.5f;
  EXPECT_EQ(r.extrapolate({1, 1, 1}, r.normal), Rgb(1, 2, 3));
  r.footprint.order = 1;
  EXPECT_EQ(r.extrapolate({1, 1, 1}, r.normal), Rgb(1.5f, 2.5f, 3.5f));
  EXPECT_EQ(r.extrapolate({-4, 0, 0}, r.normal), Rgb(0, 2, 3));
  r.jet.hessian = {2, 0, 0, 0, 0, 0};
  r.curvature_scale = 0.25f;
  EXPECT_EQ(r.extrapolate({1, 1, 1}, r.normal), Rgb(1.5f, 2.5f, 3.5f)) << "first order";
  r.footprint.order = 2;
  EXPECT_EQ(r.extrapolate({1, 1, 1}, r.normal), Rgb(2, 3.5f, 5)) << "half of 1, 2 and 3 on top";
  // (0,0,1) x (0,1,0) = (-1,0,0): the rotation that brings the normal to the query's
  EXPECT_EQ(r.extrapolate({}, {0, 1, 0}), Rgb(0.5f, 2, 3));
}

}  // namespace
}  // namespace isophote::test
