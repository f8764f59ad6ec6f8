#include "isophote/sampling/spherical_triangle.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

TEST(SolidAngle, OfAnOctantAndOfTheSidesOfACube) {
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 3, 0}, {0, 0, 2}), M_PI / 2, 1e-15);
  EXPECT_NEAR(solid_angle({1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}), M_PI / 3, 1e-15);
  EXPECT_NEAR(solid_angle({1, 1, 1}, {-1, -1, 1}, {-1, 1, 1}), M_PI / 3, 1e-15);
}

TEST(SolidAngle, OfTheSmallestIsAreaOverDistanceSquared) {
  const Vec3d a{1000, 0, 0}, b{1000, 1e-3, 0}, c{1000, 0, 1e-4};
  EXPECT_NEAR(solid_angle(a, b, c) / 5e-14, 1, 1e-10);
}

TEST(SolidAngle, NextToThePlaneIsAHalfSpace) {
  EXPECT_NEAR(solid_angle({1, 0, 1e-9}, {-1, 1, 1e-9}, {-1, -1, 1e-9}), 2 * M_PI, 1e-7);
}

TEST(SolidAngle, IsAboutWhatTheCheapOneSays) {
  Random random(3);
  const auto corner = [&] { return Vec3d(2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1); };
  for (int i = 0; i < 100000; ++i) {
    const Vec3d a = corner(), b = corner(), c = corner();
    const double ratio = about_solid_angle(a, b, c) / solid_angle(a, b, c);
    ASSERT_TRUE(ratio > 0.93 && ratio < M_PI / 2 + 1e-6) << ratio;
  }
}

void expect_uniform(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double angle = solid_angle(a, b, c);
  const double side = dot(a, cross(b, c));
  const auto inside = [&](const Vec3& d_) {
    const Vec3d d(d_);
    return dot(d, cross(a, b)) * side >= 0 && dot(d, cross(b, c)) * side >= 0 && dot(d, cross(c, a)) * side >= 0;
  };
  statistics::expect_density([&](Random& r) { return Vec3(uniform_spherical_triangle(a, b, c, angle, r.next2())); },
                             [&](const Vec3& d) { return inside(d) ? 1 / angle : 0; }, 40000, 64);
}

TEST(UniformSphericalTriangle, FillsAnOctantASliverAndNearlyAHalfSpace) {
  expect_uniform({1, 0, 0}, {0, 3, 0}, {0, 0, 2});
  expect_uniform({-10, 1, 0}, {10, 1, 0}, {10, 1, 0.5});
  expect_uniform({1, 0, 0.01}, {-1, 2, 0.01}, {-1, -2, 0.01});
}

TEST(UniformSphericalTriangle, IsFiniteAtTheCorners) {
  const Vec3d a{1, 2, 3}, b{2, 1, 3}, c{2, 2, 2};
  const double angle = solid_angle(a, b, c);
  for (const float x : {0.0f, 1 - 0x1p-24f})
    for (const float y : {0.0f, 1 - 0x1p-24f})
      EXPECT_NEAR(length(uniform_spherical_triangle(a, b, c, angle, {x, y})), 1, 1e-6) << x << ' ' << y;
}

}  // namespace
}  // namespace isophote
