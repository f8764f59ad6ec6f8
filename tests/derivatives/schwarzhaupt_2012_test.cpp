#include "isophote/derivatives/schwarzhaupt_2012.h"

#include <gtest/gtest.h>

#include "derivatives/hessian_room.h"

namespace isophote::test {
namespace {

using Walls = AnalyticRoom::Walls;

Jet<Rgb> closed(const HemisphereGather& gather) { return schwarzhaupt_2012(gather, Horizon::closed); }
Jet<Rgb> open(const HemisphereGather& gather) { return schwarzhaupt_2012(gather, Horizon::open); }

// Values of an independent program, which closed the pole by a ray of its own: hence the tolerance.
TEST(Schwarzhaupt, CentreSamplesInTheSmoothRoom) {
  const Jet<Rgb> jet = closed(gather_floor(AnalyticRoom(Walls::smooth, true), 0.9, 0.8, {8, 25}));
  EXPECT_NEAR(jet.translational.x.r, -0.590314816, 1e-3);
  EXPECT_NEAR(jet.translational.y.r, -0.244134709, 1e-3);
  EXPECT_NEAR(jet.hessian.xx, 0.250693489, 1e-3);
  EXPECT_NEAR(jet.hessian.xy, -0.299616070, 1e-3);
  EXPECT_NEAR(jet.hessian.yy, -0.426151198, 1e-3);
}

TEST(Schwarzhaupt, ConvergesClosed) {
  expect_errors_below("triangulated hemisphere, closed",
                      {{0, {0.048, 0.14}, {0.024, 0.068}},
                       {1, {0.043, 0.12}, {0.016, 0.055}},
                       {2, {0.047, 0.35}, {0.023, 0.24}},
                       {3, {0.19, 0.27}, {0.082, 0.23}},
                       {4, {0.10, 0.68}, {0.047, 0.48}}},
                      closed);
}

TEST(Schwarzhaupt, ConvergesOpen) {
  expect_errors_below(
      "triangulated hemisphere, open",
      {{0, {0.11, 0.58}, {0.054, 0.29}}, {2, {0.15, 0.57}, {0.073, 0.36}}, {4, {0.15, 0.71}, {0.067, 0.46}}}, open);
}

TEST(Schwarzhaupt, AFurnaceHasNoDerivativesIfClosed) {
  const HemisphereGather gather = furnace(AnalyticRoom(Walls::smooth, true), {16, 50}, Rgb(1));
  const auto size = [](const Jet<Rgb>& jet) {
    return std::hypot(jet.translational.x.r, jet.translational.y.r) + std::abs(jet.hessian.xx) +
           std::abs(jet.hessian.yy);
  };
  EXPECT_EQ(size(closed(gather)), 0);
  EXPECT_GT(size(open(gather)), 1e-2);
}

TEST(Schwarzhaupt, SkyIsFinite) {
  HemisphereGather gather = gather_floor(AnalyticRoom(Walls::smooth, true), 0.9, 0.8, {16, 50}, 1);
  for (std::size_t i = 0; i < gather.samples.size(); ++i) gather.samples[i].distance = i % 3 ? infinity : 1;
  const Jet<Rgb> mixed = closed(gather);
  EXPECT_TRUE(is_finite(mixed.translational.x) && std::isfinite(mixed.hessian.xx + mixed.hessian.yy));
}

}  // namespace
}  // namespace isophote::test
