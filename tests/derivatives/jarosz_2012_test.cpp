#include "isophote/derivatives/jarosz_2012.h"

#include <gtest/gtest.h>

#include "derivatives/hessian_room.h"
#include "isophote/derivatives/krivanek_2005a.h"

namespace isophote::test {
namespace {

using Walls = AnalyticRoom::Walls;

// One sample of a surface that nothing hides: the kernel's own derivatives, against values known beforehand.
TEST(SurfaceArea, DerivativesOfOnePiece) {
  const Vec3d y{0.5, 0.3, 1.2}, normal = normalize(Vec3d{-0.2, 0.1, -1});
  const double r = length(y), cos_x = y.z / r, cos_y = -dot(normal, y) / r, kernel = cos_x * cos_y / (r * r);
  EXPECT_NEAR(kernel, 0.469407811884, 1e-10);
  GatherSample sample;
  sample.direction = Vec3(y / r), sample.distance = static_cast<float>(r), sample.normal = Vec3(normal);
  // An estimate of pi/K sum L: L such that the sum is the kernel.
  sample.radiance = Rgb(static_cast<float>(kernel / M_PI));
  const HemisphereGather gather{{}, Frame(Vec3{0, 0, 1}), {1, 1}, {sample}};
  const Jet<Rgb> jet = jarosz_2012(gather);
  EXPECT_NEAR(jet.value.r, 0.469407811884, 1e-7);
  EXPECT_NEAR(jet.translational.x.r, 0.453502017674, 1e-6);
  EXPECT_NEAR(jet.translational.y.r, 0.353415949671, 1e-6);
  EXPECT_NEAR(jet.hessian.xx, -0.332049260996, 2e-6);
  EXPECT_NEAR(jet.hessian.xy, 0.525044728040, 2e-6);
  EXPECT_NEAR(jet.hessian.yy, -0.685003253433, 2e-6);
  EXPECT_EQ(krivanek_2005a(gather).translational, jet.translational);
  EXPECT_EQ(krivanek_2005a(gather).hessian, Sym3{});
}

TEST(SurfaceArea, ConvergesWhereNothingHides) {
  expect_errors_below("surface-area form", {{0, {0.036, 0.14}, {0.011, 0.042}}, {1, {0.030, 0.075}, {0.010, 0.020}}},
                      jarosz_2012);
}

// Behind an occluder it is wrong, whatever the number of rays: this is what being unaware of occlusion means.
TEST(SurfaceArea, IsUnawareOfOcclusion) {
  for (const int point : {2, 3, 4}) {
    const DerivativeErrors fine = rms_errors(known_points[point], {32, 100}, 8, jarosz_2012);
    EXPECT_GT(fine.gradient, 0.2);
    EXPECT_GT(fine.hessian, 0.9);
  }
}

TEST(SurfaceArea, SkyHasNoDerivatives) {
  HemisphereGather gather = gather_floor(AnalyticRoom(Walls::smooth, true), 0.9, 0.8, {8, 25}, 1);
  for (GatherSample& s : gather.samples) s.distance = infinity;
  const Jet<Rgb> jet = jarosz_2012(gather);
  EXPECT_EQ(jet.translational, Gradient<Rgb>{});
  EXPECT_EQ(jet.hessian, Sym3{});
}

}  // namespace
}  // namespace isophote::test
