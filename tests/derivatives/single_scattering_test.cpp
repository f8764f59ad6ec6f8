// The closed forms that the tests of media rest on, against values of an independent program and differences.
#include "support/single_scattering.h"

#include <gtest/gtest.h>

#include <functional>

namespace isophote::test {
namespace {

using Kind = AnalyticMedium::Kind;

const Vec3d at{-0.4, 0.35, 1.3}, light{0.6, -0.2, 0.7};
const Vec3d wo = normalize(Vec3d{0.5, -0.6, 0.3}), sun = normalize(Vec3d{-1, 0.15, -0.7});

void expect_near(const LogJet& jet, double value, const Vec3d& gradient) {
  EXPECT_NEAR(jet.value, value, 1e-9);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(jet.gradient()[i], gradient[i], 1e-9);
}
void expect_near(const Sym3d& a, const Sym3d& b, double tolerance) {
  EXPECT_LT(norm(a + b * -1), tolerance) << a.xx << " " << a.xy << " " << a.xz << " " << a.yy << " " << a.yz << " "
                                         << a.zz;
}

LogJet point(Kind kind, double g) { return scattered_point(at, light, 10, AnalyticMedium(kind), {g}, wo); }

TEST(SingleScattering, OfAPointLightHasTheValuesOfAnIndependentProgram) {
  expect_near(point(Kind::none, 0), 0.478661482983, {0.575833363, -0.3167083496, -0.3455000178});
  expect_near(point(Kind::homogeneous, 0), 0.251213652828, {0.3996283893, -0.2197956141, -0.2397770336});
  expect_near(point(Kind::homogeneous, 0.6), 0.0534780461776, {0.0897425951, -0.0632804744, -0.0281433163});
  expect_near(point(Kind::fog, 0), 0.340588233606, {0.4794497768, -0.2636973772, -0.2241984754});
  expect_near(point(Kind::blob, 0.6), 0.0334648725045, {0.0543544833, -0.0546799053, 0.0091876999});
  expect_near(point(Kind::homogeneous, 0.6).hessian(),
              {0.16795961937, -0.16250359395, -0.08168238742, 0.04499466954, 0.05330199505, -0.03477927237}, 1e-9);
  expect_near(point(Kind::fog, 0).hessian(),
              {0.73032201347, -0.66537448464, -0.67469198432, -0.11349381023, 0.37108059138, -0.14294273111}, 1e-9);
  expect_near(point(Kind::blob, 0.6).hessian(),
              {0.14734157379, -0.11678806049, 0.00823706720, 0.12453116037, 0.00628683362, 0.00151762878}, 1e-9);
}

TEST(SingleScattering, OfOtherLightsHasThem) {
  const AnalyticMedium homogeneous(Kind::homogeneous);
  expect_near(scattered_area(at, light, normalize(Vec3d{-1, 0.3, 0.2}), 10, homogeneous, {0.6}, wo), 0.050137030814,
              {0.0752764373, -0.0642086005, -0.0366762147});
  expect_near(scattered_directional(at, sun, 8, {1, 0, 0}, 1, homogeneous, {0.6}, wo), 0.049611258968,
              {0.0305068906, 0, 0});
  expect_near(scattered_directional(at, sun, 8, {1, 0, 0}, 1, AnalyticMedium(Kind::fog), {0}, wo), 0.533925205151,
              {0.0341846668, 0, 0.1174080235});
}

/// Central differences of the sixth order.
template <class F>
auto difference(const F& f, const Vec3d& axis) {
  constexpr double h = 2e-3;
  const auto odd = [&](int n) { return f(at + axis * (n * h)) - f(at - axis * (n * h)); };
  return (odd(1) * 45.0 - odd(2) * 9.0 + odd(3)) * (1 / (60 * h));
}

void expect_differences(const std::function<LogJet(const Vec3d&)>& scattered, bool second) {
  const LogJet jet = scattered(at);
  for (int i = 0; i < 3; ++i) {
    Vec3d axis;
    axis[i] = 1;
    EXPECT_NEAR(difference([&](const Vec3d& x) { return scattered(x).value; }, axis), dot(jet.gradient(), axis), 1e-9);
    if (!second) continue;
    const Vec3d row = difference([&](const Vec3d& x) { return scattered(x).gradient(); }, axis);
    EXPECT_LT(length(row - jet.hessian() * axis), 1e-9);
  }
}

TEST(SingleScattering, IsDifferentiatedAsDifferencesSay) {
  const Vec3d axis = normalize(at - light + Vec3d{0.2, 0.1, -0.1}), normal = normalize(Vec3d{-1, 0.3, 0.2});
  for (const Kind kind : {Kind::none, Kind::homogeneous, Kind::fog, Kind::blob})
    for (const double g : {0.0, 0.6, -0.3}) {
      const AnalyticMedium medium(kind);
      expect_differences([&](const Vec3d& x) { return scattered_point(x, light, 10, medium, {g}, wo); }, true);
      expect_differences([&](const Vec3d& x) { return scattered_spot(x, light, axis, 4, 10, medium, {g}, wo); }, true);
      expect_differences([&](const Vec3d& x) { return scattered_area(x, light, normal, 10, medium, {g}, wo); }, true);
      expect_differences(
          [&](const Vec3d& x) {
            return scattered_directional(x, sun, 8, {1, 0, 0}, 1, medium, {g}, wo);
          },
          false);
    }
}

}  // namespace
}  // namespace isophote::test
