#include "isophote/scene/phase.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

/// The usual form, in double precision.
double textbook(double g, double cosine) {
  return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// The mean of f(cosine) over the sphere, times 4 pi: composite Gauss-Legendre over 1 - cosine = 2 s^4 from the peak
/// on.
template <class F>
double integral(float g, const F& f) {
  constexpr int steps = 2000;
  constexpr double node = 0.57735026918962576;
  const double side = g < 0 ? -1 : 1;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (const double offset : {-node, node}) {
      const double s = (i + 0.5 + offset / 2) / steps;
      sum += f(side * (1 - 2 * s * s * s * s)) * 8 * s * s * s / (2 * steps);
    }
  return 2 * M_PI * sum;
}

class HenyeyGreenstein : public testing::TestWithParam<float> {
 protected:
  const float g = GetParam();
};

TEST_P(HenyeyGreenstein, IsADensityWhoseMeanCosineIsG) {
  const auto phase = [this](double cosine) { return henyey_greenstein(g, static_cast<float>(cosine)); };
  const double tolerance = 2e-6 / (1 - std::abs(g));  // cosines near 1 are rounded to floats
  EXPECT_NEAR(integral(g, phase), 1, tolerance);
  EXPECT_NEAR(integral(g, [&](double cosine) { return cosine * phase(cosine); }), g, tolerance);
}

TEST_P(HenyeyGreenstein, AgreesWithTheUsualForm) {
  for (int i = 0; i <= 200; ++i) {
    const float cosine = static_cast<float>(i - 100) / 100;
    const double expected = textbook(g, cosine);
    EXPECT_NEAR(henyey_greenstein(g, cosine), expected, 3e-6 * expected) << cosine;
  }
}

TEST_P(HenyeyGreenstein, SamplesFollowIt) {
  constexpr int rows = 64, columns = 8, draws = 200000;
  // The share of cosines above one, by integrating the phase function.
  const auto above = [this](double cosine) {
    const double h = g;
    if (std::abs(h) < 1e-6) return (1 - cosine) / 2 * (1 + h * (1 + cosine) * 1.5);
    return (1 - h * h) / (2 * h) * (1 / (1 - h) - 1 / std::sqrt(1 + h * h - 2 * h * cosine));
  };
  std::vector<double> observed(rows * columns), expected(rows * columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      expected[i * columns + j] =
          draws * (above(std::cos(M_PI * (i + 1) / rows)) - above(std::cos(M_PI * i / rows))) / columns;
  Random random(1);
  for (int n = 0; n < draws; ++n) {
    const Vec3d d(sample_henyey_greenstein(g, {0, 0, 1}, random.next2()));
    const double theta = std::atan2(std::hypot(d.x, d.y), d.z), turn = std::atan2(d.y, d.x) / (2 * M_PI) + 0.5;
    observed[std::min(rows - 1, static_cast<int>(theta / M_PI * rows)) * columns +
             std::min(columns - 1, static_cast<int>(turn * columns))] += 1;
  }
  EXPECT_GT(statistics::chi_squared_chance(observed, expected), 1e-4);
}

TEST_P(HenyeyGreenstein, SamplesAreAboutAnyDirection) {
  Random random(3);
  for (const Vec3& forward : {normalize(Vec3{1, 2, -3}), Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    statistics::Estimate cosine;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 d = sample_henyey_greenstein(g, forward, random.next2());
      ASSERT_NEAR(length(d), 1, 1e-5);
      cosine.add(dot(d, forward));
    }
    EXPECT_NEAR(cosine.mean(), g, 4.5 * cosine.standard_error());
  }
}

TEST_P(HenyeyGreenstein, EndsOfTheSquareAreStraightOnAndBack) {
  const Vec3 forward = normalize(Vec3{1, 2, -3});
  EXPECT_NEAR(dot(sample_henyey_greenstein(g, forward, {0, 0.3f}), forward), 1, 1e-6);
  EXPECT_NEAR(dot(sample_henyey_greenstein(g, forward, {1, 0.3f}), forward), -1, 1e-6);
  EXPECT_TRUE(is_finite(sample_henyey_greenstein(g, forward, {0.99999994f, 0.99999994f})));
}

INSTANTIATE_TEST_SUITE_P(Means, HenyeyGreenstein,
                         testing::Values(0.0f, 1e-7f, -1e-4f, 1e-3f, 0.3f, -0.6f, 0.85f, -0.99f, 0.99f));

TEST_P(HenyeyGreenstein, TurnIsTheChangeOfItsLogarithm) {
  const Vec3d direction = normalize(Vec3d{0.3, -0.8, 0.2}), across = normalize(cross(direction, {0, 0, 1}));
  for (const Vec3d& aim : {Vec3d{1, 2, -1}, Vec3d{0.5, -1, 0.1}, Vec3d{-0.2, 0.7, 0.7}}) {
    const Vec3d other = normalize(aim);
    const auto logarithm = [&](double angle) {
      return std::log(
          textbook(static_cast<double>(g), dot(direction * std::cos(angle) + across * std::sin(angle), other)));
    };
    const Vec3 turn = henyey_greenstein_turn(g, Vec3(direction), Vec3(other));
    const double expected = (logarithm(1e-4) - logarithm(-1e-4)) / 2e-4;
    EXPECT_NEAR(static_cast<double>(dot(turn, Vec3(across))), expected, 1e-4 + 1e-4 * std::abs(expected));
    EXPECT_NEAR(dot(turn, Vec3(direction)), 0, 1e-5f * (1 + length(turn)));
  }
}

TEST(HenyeyGreensteinExtremes, StayFinite) {
  const float g = std::nextafter(1.0f, 0.0f);
  for (const float sign : {-1.0f, 1.0f}) {
    EXPECT_TRUE(std::isfinite(henyey_greenstein(sign * g, sign)));
    EXPECT_TRUE(std::isfinite(henyey_greenstein(sign * g, sign * 1.000001f)));
    for (const float u : {0.0f, 0.5f, 0.99999994f})
      EXPECT_NEAR(length(sample_henyey_greenstein(sign * g, {0, 1, 0}, {u, u})), 1, 1e-5);
  }
}

}  // namespace
}  // namespace isophote
