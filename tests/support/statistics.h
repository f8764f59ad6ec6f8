#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "isophote/core/vec.h"

namespace isophote::statistics {

/// Independent numbers: statistical tests assume independence, which stratified sequences lack.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float next() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
  Vec2 next2() {
    const float x = next();
    return {x, next()};
  }

 private:
  std::mt19937 engine_;
};

/// Mean and standard error of independent samples.
class Estimate {
 public:
  void add(double x) { ++count_, sum_ += x, squares_ += x * x; }
  double mean() const { return sum_ / count_; }
  double standard_error() const { return std::sqrt(std::max(0.0, squares_ / count_ - mean() * mean()) / count_); }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

/// Within 4.5 standard errors of `truth` (chance of a false alarm 7e-6), the standard error being at most `power` of
/// it.
inline void expect_mean(const Estimate& e, double truth, double power) {
  EXPECT_LE(e.standard_error(), power * std::abs(truth));
  EXPECT_NEAR(e.mean(), truth, 4.5 * e.standard_error() + 1e-6 * std::abs(truth));
}
inline void expect_same_mean(const Estimate& a, const Estimate& b, double power) {
  const double error = std::hypot(a.standard_error(), b.standard_error());
  EXPECT_LE(error, power * std::abs(a.mean()));
  EXPECT_NEAR(a.mean(), b.mean(), 4.5 * error);
}

/// The chance of a chi-squared statistic at least as large as that of these counts (Wilson-Hilferty approximation).
/// Cells of less than 5 expected are pooled.
inline double chi_squared_chance(const std::vector<double>& observed, const std::vector<double>& expected) {
  double statistic = 0, pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double o, double e) { statistic += (o - e) * (o - e) / e, ++cells; };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5) {
      add(observed[i], expected[i]);
    } else {
      pooled_observed += observed[i], pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= 5) add(pooled_observed, pooled_expected);
  EXPECT_LE(pooled_observed, 20 + 2 * pooled_expected) << "samples where the density is next to 0";
  const double k = cells - 1, spread = 2 / (9 * k);
  return 0.5 * std::erfc((std::cbrt(statistic / k) - (1 - spread)) / std::sqrt(2 * spread));
}

/// Directions drawn by `sample` (none: the draw is lost) have the density `pdf` in solid angle, by a chi-squared test
/// over cells of (z, azimuth), for which the density is integrated numerically.
inline void expect_density(const std::function<std::optional<Vec3>(Random&)>& sample,
                           const std::function<double(const Vec3&)>& pdf, int draws = 200000, int fine = 24) {
  constexpr int rows = 32, columns = 32;
  std::vector<double> observed(rows * columns + 1), expected(rows * columns + 1);
  Random random(1);
  for (int i = 0; i < draws; ++i) {
    const std::optional<Vec3> d = sample(random);
    int cell = rows * columns;
    if (d) {
      EXPECT_NEAR(length(*d), 1, 1e-5);
      const double turn = std::atan2(d->y, d->x) / (2 * M_PI) + 0.5;
      const int row = std::min(rows - 1, static_cast<int>((d->z + 1) / 2 * rows));
      cell = row * columns + std::min(columns - 1, static_cast<int>(turn * columns));
    }
    observed[cell] += 1;
  }
  double total = 0;
  for (int i = 0; i < rows * fine; ++i)
    for (int j = 0; j < columns * fine; ++j) {
      const double z = 2 * (i + 0.5) / (rows * fine) - 1, phi = 2 * M_PI * ((j + 0.5) / (columns * fine) - 0.5);
      const double r = std::sqrt(1 - z * z);
      const double p =
          pdf(Vec3(Vec3d{r * std::cos(phi), r * std::sin(phi), z})) * 4 * M_PI / (rows * fine * columns * fine);
      expected[(i / fine) * columns + j / fine] += p * draws;
      total += p;
    }
  EXPECT_LT(total, 1.002);
  expected.back() = std::max(0.0, 1 - total) * draws;
  EXPECT_GT(chi_squared_chance(observed, expected), 1e-4);
}

}  // namespace isophote::statistics
