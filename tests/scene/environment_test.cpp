#include "isophote/scene/environment.h"

#include <gtest/gtest.h>

#include "isophote/sampling/warp.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::Random;

EnvironmentMap grey(int width, int height, float value) {
  EnvironmentMap map;
  map.radiance = RgbImage(width, height, Rgb(value));
  return map;
}

/// Peaks of very different strength, on a size that no power of two divides.
EnvironmentMap two_suns() {
  EnvironmentMap map = grey(50, 25, 0.1f);
  map.radiance.at(7, 6) = Rgb(5000.0f);
  map.radiance.at(30, 9) = Rgb(400.0f);
  map.radiance.at(31, 9) = Rgb(200.0f);
  return map;
}

/// A cosine-distributed ray may go to a pole exactly, where a texel has no width; its row may be too dark to be
/// sampled.
TEST(Environment, DensitiesAreFiniteAtThePoles) {
  for (const float pole : {0.0f, 0.01f, 1.0f, 500.0f}) {
    EnvironmentMap map = grey(4, 4000, 1);
    for (int x = 0; x < 4; ++x) map.radiance.at(x, 0) = map.radiance.at(x, 3999) = Rgb(pole);
    const Environment environment(map);
    for (const Vec3& d : {Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
      const Vec2 point = environment.point(d);
      EXPECT_TRUE(std::isfinite(environment.rest_pdf(point)) && std::isfinite(environment.peak_pdf(point))) << pole;
    }
  }
}

TEST(Environment, PeaksAreSampledByTheirPdf) {
  const EnvironmentMap map = two_suns();
  const Environment environment(map);
  statistics::expect_density([&](Random& r) { return environment.direction(environment.sample_peaks(r.next2())); },
                             [&](const Vec3& d) { return environment.peak_pdf(environment.point(d)); }, 20000, 48);
}

TEST(Environment, EveryPointIsAPeakOrOfTheRestAndHasADensity) {
  const EnvironmentMap map = two_suns();
  const Environment environment(map);
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 peak = environment.sample_peaks(random.next2()), rest = environment.sample_rest(random.next2());
    EXPECT_TRUE(environment.in_peak(peak) && environment.peak_pdf(peak) > 0 && environment.rest_pdf(peak) == 0);
    EXPECT_TRUE(!environment.in_peak(rest) && environment.peak_pdf(rest) == 0 && environment.rest_pdf(rest) > 0);
    const Vec2 any = random.next2();
    EXPECT_EQ(environment.in_peak(any), environment.peak_pdf(any) > 0);
    EXPECT_EQ(environment.in_peak(any), !(environment.rest_pdf(any) > 0));
  }
}

TEST(Environment, PowersAreLuminanceOverSolidAngle) {
  const EnvironmentMap map = two_suns();
  const Environment environment(map);
  Estimate peaks, rest;
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const Vec2 peak = environment.sample_peaks(random.next2()), other = environment.sample_rest(random.next2());
    peaks.add(luminance(environment.radiance(peak)) / environment.peak_pdf(peak));
    rest.add(luminance(environment.radiance(other)) / environment.rest_pdf(other));
  }
  statistics::expect_mean(peaks, environment.peak_power(), 0.01);
  statistics::expect_mean(rest, environment.rest_power(), 0.01);
}

TEST(Environment, FaintPeaksAreFoundBesideTheStrongest) {
  // A tenth of the choice is uniform over the peaks: with the sun hidden, the others do not become fireflies.
  constexpr int width = 512, height = 256;
  EnvironmentMap map = grey(width, height, 0.1f);
  map.radiance.at(20, 128) = Rgb(1e8f);
  map.radiance.at(300, 128) = Rgb(1e5f);
  const Environment environment(map);
  int peaks = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec2 middle{(static_cast<float>(x) + 0.5f) / width, (static_cast<float>(y) + 0.5f) / height};
      if (!environment.in_peak(middle)) continue;
      ++peaks;
      const double solid_angle = 2 * pi * pi / (width * height);  // at the horizon
      EXPECT_GT(environment.peak_pdf(middle) * solid_angle, 0.99 * 0.1 / 10);
    }
  EXPECT_EQ(peaks, 10);  // the sun shines into its neighbours
}

TEST(Environment, HugePixelsStayFinite) {
  for (const float value : {4e37f, std::numeric_limits<float>::max()}) {
    EnvironmentMap map = grey(32, 16, 1.0f);
    for (const int x : {3, 4, 5, 20}) map.radiance.at(x, 7) = Rgb(value);
    for (const bool everywhere : {false, true}) {
      if (everywhere) map.radiance = RgbImage(32, 16, Rgb(value));
      const Environment environment(map);
      EXPECT_EQ(environment.peak_power() > 0, !everywhere);
      EXPECT_TRUE(std::isfinite(environment.peak_power() + environment.rest_power()));
      ASSERT_GT(environment.rest_power(), 0);
      Random random(4);
      for (int i = 0; i < 1000; ++i) {
        const Vec2 rest = environment.sample_rest(random.next2());
        EXPECT_TRUE(environment.rest_pdf(rest) > 0 && std::isfinite(environment.rest_pdf(rest)));
        EXPECT_TRUE(is_finite(environment.radiance(rest)));
        if (!everywhere) {
          EXPECT_GT(environment.peak_pdf(environment.sample_peaks(random.next2())), 0);
        }
      }
    }
  }
}

TEST(Environment, WhatIsNoRadianceHasNoWeight) {
  EnvironmentMap map = grey(16, 8, 1.0f);
  map.radiance.at(3, 3) = Rgb(NAN);
  map.radiance.at(9, 3) = Rgb(-5.0f);
  map.radiance.at(5, 5) = Rgb(INFINITY);
  const Environment environment(map);
  EXPECT_TRUE(std::isfinite(environment.peak_power()));
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = environment.sample_rest(random.next2());
    EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    environment.radiance(p);
  }
  environment.radiance({NAN, NAN});  // reads no pixel outside
  EXPECT_FALSE(environment.in_peak({NAN, NAN}));
}

TEST(Environment, BlackOnesHaveNothingToSample) {
  const EnvironmentMap map = grey(8, 4, 0.0f);
  const Environment environment(map);
  EXPECT_EQ(environment.peak_power() + environment.rest_power(), 0);
  EXPECT_EQ(environment.rest_pdf({0.5f, 0.5f}) + environment.peak_pdf({0.5f, 0.5f}), 0);
}

}  // namespace
}  // namespace isophote
