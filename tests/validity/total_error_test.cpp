#include "isophote/validity/total_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "isophote/core/frame.h"
#include "isophote/validity/settle.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr float any_aspect = std::numeric_limits<float>::infinity();
const Vec3 up{0, 0, 1};

/// Of value 2, in the plane z = 0.
Jet<Rgb> curved(float xx, float xy, float yy) {
  Jet<Rgb> jet;
  jet.value = Rgb(2);
  jet.hessian = {xx, xy, 0, yy, 0, 0};
  jet.distances.harmonic_mean = 100;
  return jet;
}
View view_of(float error_rate) {
  View view;
  view.scene_scale = 100;
  view.pilot = {true, error_rate, 2};
  return view;
}
float reach(const Footprint& f, const Vec3& d) { return 1 / std::sqrt(quadratic_form(f.shape, d)); }

/// The integral over the footprint, in the plane, of half of |second-order term| over E.
double integral(const Footprint& f, const std::function<double(double, double)>& term) {
  double sum = 0;
  constexpr int n = 800;
  const double cell = 2.0 * f.radius / n;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = (i + 0.5) * cell - f.radius, y = (k + 0.5) * cell - f.radius;
      if (quadratic_form(f.shape, Vec3(Vec3d(x, y, 0))) < 1) sum += term(x, y) / 2 * cell * cell;
    }
  return sum;
}

// The integral is eps, for disks exactly, for the plain ellipse (k + 1/k)/2 times as much, k^4 the ratio of curvatures.
TEST(TotalError, IsTheIntegralOfTheSecondOrderTerm) {
  const float wanted = 0.05f, rate = 0.3f;
  const double eps = std::pow(wanted / rate, 2);
  for (const auto& [first, second] : {std::pair{3.0f, 3.0f}, {3.0f, 0.5f}}) {
    const auto term = [a = first, b = second](double x, double y) { return (a * x * x + b * y * y) / 2; };
    const Footprint disk = total_error(curved(first, 0, second), view_of(rate), wanted, {}, 1);
    EXPECT_NEAR(integral(disk, term) / eps, 1, 0.01);
    EXPECT_FLOAT_EQ(reach(disk, {1, 0, 0}), reach(disk, {0, 1, 0}));
    const Footprint ellipse = total_error(curved(first, 0, second), view_of(rate), wanted, {}, any_aspect);
    const double k = std::pow(first / second, 0.25);
    EXPECT_NEAR(integral(ellipse, term) / eps, (k + 1 / k) / 2, 0.01);
    EXPECT_NEAR(reach(ellipse, {0, 1, 0}) / reach(ellipse, {1, 0, 0}), k, 1e-4);
  }
}

// Along a line the integral is eps too, whichever way the curve bends.
TEST(TotalError, LineForm) {
  for (const double curvature : {2.5, -0.3}) {
    const double eps = 0.01, radius = total_error_on_line(curvature, eps);
    double sum = 0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
      const double x = radius * (2 * (i + 0.5) / n - 1);
      sum += std::abs(curvature * x * x / 2) * 2 * radius / n;
    }
    EXPECT_NEAR(sum / eps, 1, 1e-5);
  }
}

// A record's error over its area averages to the wanted one where its own rate is the mean of all.
TEST(TotalError, TheMeanOverTheAreaIsTheWantedError) {
  const Jet<Rgb> jet = curved(3, 0.4f, -1);
  const float rate = error_rate(jet, up, 2);
  const Footprint f = total_error(jet, view_of(rate), 0.02f, {}, 1);
  const double eps = std::pow(0.02 / rate, 2);
  EXPECT_NEAR(eps / (M_PI * f.radius * f.radius), 0.02, 1e-6);
}

// Axes from the signed form, radii from absolute values: for saddles, turned ones too.
TEST(TotalError, AxesOfSaddles) {
  for (const float angle : {0.0f, 0.3f, 1.2f}) {
    const float c = std::cos(angle), s = std::sin(angle), a = 8, b = -0.5f;
    const Jet<Rgb> jet = curved(a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c);
    const Footprint f = total_error(jet, view_of(1), 0.02f, {}, any_aspect);
    EXPECT_NEAR(reach(f, {-s, c, 0}) / reach(f, {c, s, 0}), 2, 1e-3) << angle;
    EXPECT_NEAR(f.radius, reach(f, {-s, c, 0}), 1e-5);
  }
}

TEST(TotalError, AspectIsCappedAndTheNormalTakesTheShorterAxis) {
  const Footprint f = total_error(curved(1000, 0, 0.001f), view_of(1), 0.02f, {}, 2);
  EXPECT_NEAR(reach(f, {0, 1, 0}) / reach(f, {1, 0, 0}), 2, 1e-4);
  EXPECT_NEAR(reach(f, up) / reach(f, {1, 0, 0}), 1, 1e-4);
}

TEST(TotalError, TurnsWithItsNormal) {
  const Frame frame(normalize(Vec3{1, -2, 0.3f}));
  Jet<Rgb> jet = curved(0, 0, 0);
  const auto entry = [&](int i, int k) { return 5 * frame.u[i] * frame.u[k] - 0.3f * frame.v[i] * frame.v[k]; };
  jet.hessian = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  View view = view_of(1);
  view.normal = frame.n;
  const Footprint turned = total_error(jet, view, 0.02f, {}, 2);
  const Footprint flat = total_error(curved(5, 0, -0.3f), view_of(1), 0.02f, {}, 2);
  EXPECT_NEAR(reach(turned, frame.u), reach(flat, {1, 0, 0}), 1e-5);
  EXPECT_NEAR(reach(turned, frame.v), reach(flat, {0, 1, 0}), 1e-5);
  EXPECT_NEAR(reach(turned, frame.n), reach(flat, up), 1e-5);
}

// Where nothing bends, the scene bounds the radius; where nothing shines, it stays finite; bounds hold.
TEST(TotalError, FlatBlackAndBounded) {
  const Jet<Rgb> flat = curved(0, 0, 0);
  EXPECT_FLOAT_EQ(total_error(flat, view_of(1), 0.02f, {}, 2).radius, 25);
  Jet<Rgb> black = curved(1, 0, 1);
  black.value = {};
  View view = view_of(1);
  for (const float irradiance : {0.0f, 2.0f}) {
    view.pilot = {.known = true, .error_rate = 1, .irradiance = irradiance};
    const Footprint f = total_error(black, view, 0.02f, {}, 2);
    // l is over a hundredth of the picture's mean; where all is black the scene bounds the radius.
    const double expected = irradiance > 0 ? std::sqrt(0.02) * std::pow(0.04 * irradiance / M_PI, 0.25) : 25;
    EXPECT_NEAR(f.radius / expected, 1, 1e-5);
    EXPECT_TRUE(std::isfinite(f.shape.xx) && f.shape.xx > 0);
  }
  view = view_of(1);
  view.pixel = 0.01f;
  const RadiusBounds bounds{.min_pixels = 1.5f, .max_length = 0.5f};
  EXPECT_FLOAT_EQ(total_error(curved(1e9f, 0, 1e9f), view, 0.02f, bounds, 1).radius, 0.015f);
  EXPECT_FLOAT_EQ(total_error(flat, view, 0.02f, bounds, 2).radius, 0.5f);
}

// Powers of two of the unit of length change nothing but the unit.
TEST(TotalError, Scales) {
  for (const float s : {0x1p-10f, 0x1p13f}) {
    View small = view_of(0.7f), large = small;
    large.scene_scale *= s, large.pilot.error_rate /= s;
    Jet<Rgb> jet = curved(2, 0.3f, -1), far = jet;
    far.hessian = {2 / (s * s), 0.3f / (s * s), 0, -1 / (s * s), 0, 0};
    far.distances.harmonic_mean *= s;
    EXPECT_FLOAT_EQ(total_error(far, large, 0.02f, {}, 2).radius, s * total_error(jet, small, 0.02f, {}, 2).radius);
  }
}

// With a slope of 1/2 radii grow by no more than half the distance.
TEST(LipschitzClamping, HoldsForEveryPair) {
  RandomPlaces random(3);
  std::vector<Record> records;
  NeighbourIndex neighbours({{0, 0, 0}, {4, 4, 1}});
  for (std::uint32_t i = 0; i < 300; ++i) {
    records.push_back(round_record(random.point({0, 0, 0}, {4, 4, 1}), up, std::pow(10.0f, random.number(-2, 0.5f))));
    settle(Settling{records, neighbours}, {&i, 1}, {.slope = 0.5f});
  }
  for (const Record& a : records)
    for (const Record& b : records)
      EXPECT_LE(a.footprint.radius, b.footprint.radius + 0.5f * length(a.position - b.position) + 1e-5f);
}

// Raised by a lower bound, an ellipse stays one along the surface, and off it reaches no further than it did.
TEST(TotalError, ARaisedEllipseStaysAnEllipse) {
  for (const float natural : {1.9f, 0.6f, 0.1f}) {
    Record record;
    record.normal = {0, 0, 1};
    record.jet = jet_of(1);
    record.footprint = Footprint::disk(2, 1);
    record.footprint.shape = Sym3(0.25f, 0, 0, 1, 0, 1);  // semi-axes 2, 1, and 1 along the normal
    record.footprint.smallest = 2, record.footprint.unscaled = natural;
    NeighbourIndex neighbours({{-1, -1, -1}, {1, 1, 1}});
    const std::uint32_t id = 0;
    for (int twice = 0; twice < 2; ++twice) settle(Settling{{&record, 1}, neighbours}, {&id, 1}, {});
    EXPECT_FLOAT_EQ(quadratic_form(record.footprint.shape, Vec3{2, 0, 0}), 1);
    EXPECT_FLOAT_EQ(quadratic_form(record.footprint.shape, Vec3{0, 1, 0}), 1);
    const float height = std::min(1.0f, std::max(natural, 0.5f));
    EXPECT_NEAR(quadratic_form(record.footprint.shape, Vec3{0, 0, height}), 1, 1e-5);
  }
}

}  // namespace
}  // namespace isophote::test
