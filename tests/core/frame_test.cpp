#include "isophote/core/frame.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace isophote {
namespace {

template <class T>
void expect_right_handed(const FrameT<T>& f, double tolerance) {
  EXPECT_NEAR(length(f.u), 1, tolerance);
  EXPECT_NEAR(length(f.v), 1, tolerance);
  EXPECT_LT(length(cross(f.u, f.v) - f.n), tolerance);
  EXPECT_LT(length(cross(f.v, f.n) - f.u), tolerance);
}

TEST(Frame, IsRightHandedAndOrthonormalAboutAnyNormal) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},    {0, -1, 0},
                                {0, 0, 1}, {0, 0, -1}, {1, 0, -0.0}, {0, 1, -0.0}};
  for (int i = 0; i < 2000; ++i) {
    normals.push_back(normalize(Vec3d(normal(random), normal(random), normal(random))));
    // beside the poles, where simpler constructions lose their digits
    normals.push_back(normalize(Vec3d(normal(random) * 1e-5, normal(random) * 1e-5, i % 2 ? 1 : -1)));
  }
  for (const Vec3d& n : normals) {
    expect_right_handed(Framed(n), 1e-14);
    expect_right_handed(Frame(normalize(Vec3(n))), 1e-6);
    EXPECT_EQ(Framed(n).n, n);
  }
}

TEST(Frame, ToWorldAndBack) {
  const Framed f(normalize(Vec3d(0.3, -0.5, 0.7)));
  const Vec3d a{1, -2, 0.5};
  EXPECT_LT(length(f.to_local(f.to_world(a)) - a), 1e-14);
  EXPECT_LT(length(f.to_world({0, 0, 1}) - f.n), 1e-15);
}

}  // namespace
}  // namespace isophote
