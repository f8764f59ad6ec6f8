#include "isophote/core/eigen3.h"

#include <gtest/gtest.h>

#include <random>

#include "isophote/core/frame.h"

namespace isophote {
namespace {

double greatest(const Sym3d& m) {
  double most = 0;
  for (const double entry : {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz}) most = std::max(most, std::abs(entry));
  return most;
}

/// sum of l_i v_i v_i^T is the matrix, and the axes are orthonormal.
void expect_decomposed(const Sym3d& m) {
  const Eigen3 e(m);
  Sym3d back;
  for (int i = 0; i < 3; ++i) {
    back = back + Sym3d::outer(e.axes[i], e.values[i]);
    EXPECT_NEAR(length(e.axes[i]), 1, 1e-14);
    EXPECT_NEAR(dot(e.axes[i], e.axes[(i + 1) % 3]), 0, 1e-14);
  }
  EXPECT_LE(greatest(back + m * -1.0), 1e-14 * greatest(m));
}

TEST(Eigen3, TakesMatricesApart) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const auto entry = [&] { return number(random) * std::pow(10, 4 * number(random)); };
    expect_decomposed({entry(), entry(), entry(), entry(), entry(), entry()});
  }
}

TEST(Sym3, TimesItsInverseIsTheIdentity) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const auto entry = [&] { return number(random); };
    const Sym3d m{3 + entry(), entry(), entry(), 3 + entry(), entry(), 3 + entry()}, back = inverse(m);
    for (const Vec3d& v : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
      EXPECT_NEAR(length(m * (back * v) - v), 0, 1e-14);
  }
}

TEST(Eigen3, RepeatedNoneAndNearlyAlike) {
  expect_decomposed({});
  expect_decomposed(Sym3d::scaled_identity(-3));
  expect_decomposed(Sym3d::outer(normalize(Vec3d{1, -2, 0.5}), 4));
  expect_decomposed({1, 1e-17, 0, 1, 1e-9, 1 + 1e-15});
  expect_decomposed({1e300, 1e299, 0, -1e300, 1e280, 1});
  expect_decomposed({1e-300, 1e-301, 0, -1e-300, 0, 1e-305});
}

TEST(Eigen3, KnowsWhatItWasMadeOf) {
  const Framed frame(normalize(Vec3d{0.3, 0.5, -0.8}));
  const Eigen3 e(Sym3d::outer(frame.u, 4) + Sym3d::outer(frame.v, -1) + Sym3d::outer(frame.n, 0.25));
  for (const auto& [value, axis] : {std::pair{4.0, frame.u}, {-1.0, frame.v}, {0.25, frame.n}}) {
    int found = 0;
    for (int i = 0; i < 3; ++i)
      found += std::abs(e.values[i] - value) < 1e-14 && std::abs(std::abs(dot(e.axes[i], axis)) - 1) < 1e-14;
    EXPECT_EQ(found, 1) << value;
  }
}

}  // namespace
}  // namespace isophote
