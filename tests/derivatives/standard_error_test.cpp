#include "isophote/derivatives/standard_error.h"

#include <gtest/gtest.h>

#include "derivatives/hessian_room.h"
#include "isophote/derivatives/swept_edges.h"
#include "isophote/sampling/sampler.h"

namespace isophote::test {
namespace {

// Radiance with noise of its own at every ray, as a path tracer gives it: the estimate is the spread over seeds.
TEST(StandardError, IsTheSpreadOfNoisyRadiance) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, true);
  constexpr int seeds = 200;
  double sum = 0, squares = 0, estimated = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    HemisphereGather gather = gather_floor(room, 1.9, 1.45, {16, 50}, seed);
    Sampler noise(static_cast<std::uint64_t>(seed), 0);
    for (GatherSample& s : gather.samples) s.radiance *= noise.next() < 0.25f ? 4.0f : 0.0f;
    double mean = 0;
    for (const GatherSample& s : gather.samples) mean += luminance(Rgbd(s.radiance));
    mean *= std::numbers::pi / gather.strata.size();
    sum += mean / seeds, squares += mean * mean / seeds;
    estimated += standard_error(gather) / seeds;
  }
  EXPECT_NEAR(estimated / std::sqrt(squares - sum * sum), 1, 0.12);
}

// The same of the gradient, by swept edges: the root of the mean over its two components.
TEST(StandardError, OfTheGradientIsItsSpread) {
  for (const KnownPoint& p : known_points) {
    const AnalyticRoom room = p.room();
    constexpr int seeds = 200;
    Vec3d sum, squares;
    double estimated = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      HemisphereGather gather = gather_floor(room, p.x, p.y, {16, 50}, seed);
      Sampler noise(static_cast<std::uint64_t>(seed), 0);
      for (GatherSample& s : gather.samples) s.radiance *= -std::log(1 - noise.next());
      const Jet<Rgb> jet = swept_edges(gather);
      const Vec3d g{luminance(Rgbd(jet.translational.x)), luminance(Rgbd(jet.translational.y)), 0};
      sum += g / seeds, squares += Vec3d{g.x * g.x, g.y * g.y, 0} / seeds;
      estimated += std::pow(jet.gradient_error, 2) / seeds;
    }
    const double spread = (squares.x - sum.x * sum.x + squares.y - sum.y * sum.y) / 2;
    const double ratio = std::sqrt(estimated / spread);
    std::printf("  %s: %.2f of the true spread\n", p.name, ratio);
    EXPECT_GT(ratio, 0.85) << p.name;
    EXPECT_LT(ratio, 1.25) << p.name;
  }
}

// Without such noise jitter alone is left, and the walls between bright and dark are counted in full: no less than the
// spread, and not many times more.
TEST(StandardError, ErrsUpwardsWhereRadianceIsSmooth) {
  for (const KnownPoint& p : known_points) {
    const AnalyticRoom room = p.room();
    double sum = 0, squares = 0, estimated = 0;
    constexpr int seeds = 64;
    for (int seed = 0; seed < seeds; ++seed) {
      const HemisphereGather gather = gather_floor(room, p.x, p.y, {16, 50}, seed);
      double mean = 0;
      for (const GatherSample& s : gather.samples) mean += luminance(Rgbd(s.radiance));
      mean *= std::numbers::pi / gather.strata.size();
      sum += mean / seeds, squares += mean * mean / seeds;
      estimated += standard_error(gather) / seeds;
    }
    const double ratio = estimated / std::sqrt(squares - sum * sum);
    std::printf("  %s: %.2f of the true spread\n", p.name, ratio);
    EXPECT_GT(ratio, 1) << p.name;
    EXPECT_LT(ratio, 3) << p.name;
  }
}

TEST(StandardError, AFurnaceHasNone) {
  const AnalyticRoom room(AnalyticRoom::Walls::smooth, true);
  for (const Strata strata : {Strata{1, 3}, Strata{8, 25}})
    EXPECT_EQ(standard_error(furnace(room, strata, {1, 2, 3})), 0);
}

}  // namespace
}  // namespace isophote::test
