#include "isophote/validity/predicted_error.h"

#include <gtest/gtest.h>

#include "isophote/core/frame.h"
#include "isophote/core/ray.h"
#include "isophote/validity/semi_axes.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr Vec3 up{0, 0, 1};
const ErrorModel by_hessian{.by_hessian = true};

/// Value 2, Hessian 0.8 along x and -0.4 along y.
Record curved_record(int order) {
  Record r = round_record({1, 2, 3}, up, 0.5f);
  r.jet.value = Rgb(2);
  r.jet.hessian = {0.8f, 0, 0, -0.4f, 0, 0};
  r.footprint.order = static_cast<std::uint8_t>(order);
  return r;
}

TEST(PredictedError, OfAKnownHessian) {
  for (const int order : {1, 2}) {
    const Record r = curved_record(order);
    EXPECT_FLOAT_EQ(predicted_error(r, {0.5f, 0, 0}, up, by_hessian), 0.8f * 0.25f / 2 / 2);
    EXPECT_FLOAT_EQ(predicted_error(r, {0, 0.5f, 0}, up, by_hessian), 0.4f * 0.25f / 2 / 2);
    EXPECT_EQ(predicted_error(r, {}, up, by_hessian), 0);
  }
}

// A field that is a parabola, extrapolated to the first order, is off by just what is predicted.
TEST(PredictedError, IsThatOfAParabola) {
  RandomPlaces random(7);
  for (int i = 0; i < 200; ++i) {
    Record r = curved_record(static_cast<int>(i % 2));
    r.jet.translational = random.gradient(0.5f);
    r.gradient_scale = random.number(0, 1);
    const Vec3 q = random.point({-0.3f, -0.3f, 0}, {0.3f, 0.3f, 0});
    const float truth = luminance(r.jet.value + r.jet.translational.dot(q)) + quadratic_form(r.jet.hessian, q) / 2;
    const float error = std::abs(luminance(r.extrapolate(q, up)) - truth) / 2;
    EXPECT_NEAR(predicted_error(r, q, up, by_hessian), error, 1e-6f);
  }
}

TEST(PredictedError, OfAValueAloneCountsTheTurnOfTheNormal) {
  Record r = curved_record(0);
  r.jet.rotational.x = Rgb(0.5f);
  const Vec3 turned = normalize(Vec3{0, 0.1f, 1});
  EXPECT_NEAR(predicted_error(r, {}, turned, by_hessian), 0.5f * turned.y / 2, 1e-6f);
  r.footprint.order = 1;
  EXPECT_EQ(predicted_error(r, {}, turned, by_hessian), 0);
}

TEST(PredictedError, IsAtMostOneAndFiniteInTheDark) {
  Record r = curved_record(1);
  EXPECT_EQ(predicted_error(r, {100, 0, 0}, up, by_hessian), 1);
  r.jet.value = Rgb();
  EXPECT_EQ(predicted_error(r, {0.1f, 0, 0}, up, by_hessian), 1);
  r.jet.hessian = {};
  EXPECT_EQ(predicted_error(r, {0.1f, 0, 0}, up, by_hessian), 0);
}

// At the rim the metric's measure is its threshold, which aims at the wanted error; where a bound has pushed the rim
// out to twice its distance, the measure there is twice the threshold.
TEST(PredictedError, ByTheMetricsOwnMeasure) {
  const float wanted = 0.02f, a = 1.4f * std::sqrt(wanted);
  const ErrorModel model{.threshold = a, .scale = split_sphere_radius(1, a), .factor = 1.4f, .power = 0.5f};
  Record r = round_record({1, 2, 3}, up, split_sphere_radius(0.7f, a), 1 / a);
  r.footprint.unscaled = 0.7f;
  const float radius = r.footprint.radius;
  EXPECT_NEAR(predicted_error(r, {radius, 0, 0}, up, model), wanted, 1e-6f);
  EXPECT_NEAR(predicted_error(r, {0, radius / 2, 0}, up, model), wanted / 4, 1e-6f);
  EXPECT_NEAR(predicted_error_at_rim(r, model), wanted, 1e-6f);
  const Vec3 turned = normalize(Vec3{0.1f, 0, 1});
  EXPECT_NEAR(predicted_error(r, {}, turned, model), length_squared(turned - up) / 2 / (1.4f * 1.4f), 1e-6f);
  r.footprint.resize(2 * radius);
  EXPECT_NEAR(predicted_error(r, {2 * radius, 0, 0}, up, model), 4 * wanted, 1e-5f);
}

TEST(PredictedError, AtTheRimIsItsMean) {
  Record r = curved_record(1);
  // |0.8 cos^2 - 0.4 sin^2| / 2 * 0.25 / 2, its mean by quadrature in many steps
  double mean = 0;
  for (int i = 0; i < 1000; ++i) {
    const double c = std::cos(2e-3 * pi * (i + 0.5)), s = std::sin(2e-3 * pi * (i + 0.5));
    mean += std::abs(0.8 * c * c - 0.4 * s * s) / 16 / 1000;
  }
  EXPECT_NEAR(predicted_error_at_rim(r, by_hessian), mean, 0.03 * mean);
  // A footprint whose rim has the same error all around: 0.8 x^2 = 0.4 y^2.
  r.footprint.shape.yy /= 2;
  r.jet.hessian.yy = 0.4f;
  EXPECT_NEAR(predicted_error_at_rim(r, by_hessian), 0.8f * 0.25f / 4, 1e-6f);
}

TEST(SemiAxes, OfFootprintsOfEveryForm) {
  RandomPlaces random(5);
  for (int i = 0; i < 300; ++i) {
    const Frame frame(random.direction());
    const float angle = random.number(0, 3), a = random.number(0.1f, 2), b = a * random.number(0.05f, 0.95f);
    const Vec3 along = frame.u * std::cos(angle) + frame.v * std::sin(angle), across = cross(frame.n, along);
    Record r = round_record({}, frame.n, a);
    r.footprint.shape = Sym3::outer(along, 1 / (a * a)) + Sym3::outer(across, 1 / (b * b)) + Sym3::outer(frame.n, 9);
    const SemiAxes axes = semi_axes(r);
    EXPECT_NEAR(axes.longer, a, 1e-3f * a);
    EXPECT_NEAR(axes.shorter, b, 1e-3f * b);
    EXPECT_NEAR(axes.mean(), std::sqrt(a * b), 1e-3f * a);
    EXPECT_NEAR(axes.height, 1 / 3.0f, 1e-4f);
    EXPECT_NEAR(std::abs(dot(axes.axis, along)), 1, 0.01f);
    EXPECT_NEAR(dot(axes.axis, frame.n), 0, 1e-5f);
  }
  const SemiAxes disk = semi_axes(round_record({}, up, 0.3f));
  EXPECT_FLOAT_EQ(disk.longer, 0.3f);
  EXPECT_FLOAT_EQ(disk.shorter, 0.3f);
  EXPECT_FLOAT_EQ(disk.height, 0.3f);
}

TEST(BallRadius, IsThatOfTheSameVolume) {
  const Frame frame(normalize(Vec3{0.4f, -0.5f, 0.7f}));
  const auto radius = [&](float a, float b, float c) {
    Footprint f = Footprint::ball(std::max(a, std::max(b, c)));
    f.shape = Sym3::outer(frame.u, 1 / (a * a)) + Sym3::outer(frame.v, 1 / (b * b)) + Sym3::outer(frame.n, 1 / (c * c));
    return ball_radius(f);
  };
  EXPECT_NEAR(radius(0.5f, 0.3f, 0.2f), std::cbrt(0.03), 1e-6);
  EXPECT_NEAR(radius(7, 7, 7), 7, 1e-5);
  // A needle: what rounding leaves of its form along it is no more than it is at its radius.
  EXPECT_GE(radius(1, 1e-4f, 1e-4f), 0.9 * std::cbrt(1e-8));
  EXPECT_LE(radius(1, 1e-4f, 1e-4f), 1.1 * std::cbrt(1e-8));
}

}  // namespace
}  // namespace isophote::test
