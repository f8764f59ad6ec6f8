#include "isophote/derivatives/swept_edges.h"

#include <gtest/gtest.h>

#include "derivatives/hessian_room.h"

namespace isophote::test {
namespace {

using Walls = AnalyticRoom::Walls;

// Values of an independent program.
TEST(SweptEdges, CentreSamplesInTheSmoothRoom) {
  const AnalyticRoom room(Walls::smooth, true);
  const struct {
    Strata strata;
    double gx, gy, xx, xy, yy;
  } rows[] = {{{8, 25}, -0.644933526, -0.278966218, 0.107853312, -0.362028196, -0.332166615},
              {{32, 100}, -0.685387704, -0.300811000, 0.091547899, -0.371144710, -0.327163636}};
  for (const auto& row : rows) {
    const Jet<Rgb> jet = swept_edges(gather_floor(room, 0.9, 0.8, row.strata));
    EXPECT_NEAR(jet.translational.x.r, row.gx, 2e-6);
    EXPECT_NEAR(jet.translational.y.r, row.gy, 2e-6);
    EXPECT_NEAR(jet.hessian.xx, row.xx, 3e-6);
    EXPECT_NEAR(jet.hessian.xy, row.xy, 3e-6);
    EXPECT_NEAR(jet.hessian.yy, row.yy, 3e-6);
  }
}

// Of an occluder before a wall whose radiance varies the Hessian knows the edges, not the wall's own gradient: an error
// that more rays do not cure (docs/theory.md).
TEST(SweptEdges, Converges) {
  expect_errors_below("swept edges",
                      {{0, {0.011, 0.025}, {0.0036, 0.009}},
                       {1, {0.014, 0.026}, {0.0039, 0.007}},
                       {2, {0.020, 0.19}, {0.010, 0.17}},
                       {3, {0.20, 0.21}, {0.096, 0.21}},
                       {4, {0.067, 0.40}, {0.028, 0.37}},
                       // Before constant walls the Hessian of the silhouettes converges too.
                       {5, {0.16, 0.055}, {0.051, 0.019}},
                       {6, {0.092, 0.057}, {0.045, 0.024}},
                       {7, {0.70, 0.018}, {0.20, 0.007}}},
                      swept_edges);
}

// The limb of a round thing slides on it as the record moves, which no edge that stands still can know: the gradient
// converges yet, the Hessian does not (docs/theory.md). A sphere of radiance 0.1 and radius 0.35 in a room of
// radiance 1.
TEST(SweptEdges, UnderASphere) {
  const Vec3d centre(0.15, 0.1, 0.8);
  const auto errors = [&](Strata strata) {
    double gradient = 0, hessian = 0;
    constexpr int seeds = 16;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      HemisphereGather gather = gather_floor(AnalyticRoom(Walls::constant, false), 1.75, 1.35, strata, seed);
      for (GatherSample& s : gather.samples) {
        s.radiance = Rgb(1);
        const Vec3d w(s.direction);
        const double along = dot(w, centre), left = 0.35 * 0.35 - length_squared(centre - w * along);
        if (!(left > 0)) continue;
        const double distance = along - std::sqrt(left);
        s = {s.direction, static_cast<float>(distance), Rgb(0.1f), Vec3(normalize(w * distance - centre)), 99};
      }
      const Jet<Rgb> jet = swept_edges(gather);
      gradient += std::pow(jet.translational.x.r + 0.336202, 2) + std::pow(jet.translational.y.r + 0.224135, 2);
      hessian += std::pow(jet.hessian.xx - 1.86640, 2) + 2 * std::pow(jet.hessian.xy + 0.24996, 2) +
                 std::pow(jet.hessian.yy - 2.07470, 2);
    }
    return DerivativeErrors{std::sqrt(gradient / seeds) / std::hypot(0.336202, 0.224135),
                            std::sqrt(hessian / seeds) / std::hypot(1.86640, 0.24996, std::hypot(2.07470, 0.24996))};
  };
  const DerivativeErrors coarse = errors({16, 50}), fine = errors({64, 200});
  std::printf("  under a sphere: rms error of gradient / Hessian %.1f / %.0f%%, at 64x200 %.1f / %.0f%%\n",
              100 * coarse.gradient, 100 * coarse.hessian, 100 * fine.gradient, 100 * fine.hessian);
  EXPECT_LT(coarse.gradient, 0.3);
  EXPECT_LT(fine.gradient, 0.1);
  EXPECT_LT(fine.hessian, 0.55);
  EXPECT_GT(fine.hessian, 0.3);
}

TEST(SweptEdges, AFurnaceHasNoDerivatives) {
  for (const Strata strata : {Strata{1, 3}, Strata{8, 25}}) {
    const Jet<Rgb> jet = swept_edges(furnace(AnalyticRoom(Walls::smooth, true), strata, {1, 2, 3}));
    EXPECT_EQ(jet.translational, Gradient<Rgb>{});
    EXPECT_EQ(jet.hessian, Sym3{});
  }
}

// A wall between a hit and the sky lies on the hit's plane; one between two samples of the sky is nowhere.
TEST(SweptEdges, Sky) {
  const AnalyticRoom room(Walls::smooth, true);
  HemisphereGather gather = gather_floor(room, 0.9, 0.8, {16, 50}, 1);
  for (GatherSample& s : gather.samples) s.distance = infinity;
  const Jet<Rgb> open = swept_edges(gather);
  EXPECT_EQ(open.translational, Gradient<Rgb>{});
  EXPECT_EQ(open.hessian, Sym3{});

  HemisphereGather half = gather_floor(room, 0.9, 0.8, {16, 50}, 1), far = half;
  for (std::size_t i = 0; i < half.samples.size(); ++i)
    if (i % 50 < 25) half.samples[i].distance = infinity, far.samples[i].distance = 1e6f;
  const Jet<Rgb> a = swept_edges(half), b = swept_edges(far);
  EXPECT_GT(std::abs(a.translational.x.r), 0.01f);
  EXPECT_NEAR(a.translational.x.r, b.translational.x.r, 1e-4);
  EXPECT_NEAR(a.hessian.xx, b.hessian.xx, 1e-4);
}

// The derivatives turn with the frame in which the strata lie, and every channel has its own gradient.
TEST(SweptEdges, TurnWithTheirFrame) {
  const AnalyticRoom room(Walls::smooth, true);
  HemisphereGather gather = gather_floor(room, 0.9, 0.8, {8, 25}, 3);
  const Jet<Rgb> flat = swept_edges(gather);
  const Frame turned(normalize(Vec3{1, -2, 0.5f}));
  const auto turn = [&](const Vec3& v) { return turned.to_world(v); };
  gather.frame = turned;
  for (GatherSample& s : gather.samples) {
    s.direction = turn(s.direction), s.normal = turn(s.normal);
    s.radiance = {s.radiance.r, 2 * s.radiance.r, 0};
  }
  const Jet<Rgb> jet = swept_edges(gather);
  const Vec3 gradient = turn({flat.translational.x.r, flat.translational.y.r, 0});
  EXPECT_NEAR(jet.translational.y.r, gradient.y, 1e-6);
  EXPECT_NEAR(jet.translational.z.g, 2 * gradient.z, 1e-6);
  EXPECT_EQ(jet.translational.x.b, 0);
  EXPECT_NEAR(quadratic_form(jet.hessian, turned.n), 0, 1e-6);
  const float luminous = luminance(Rgb(1, 2, 0));
  EXPECT_NEAR(quadratic_form(jet.hessian, turned.u), luminous * flat.hessian.xx, 3e-6);
  EXPECT_NEAR(quadratic_form(jet.hessian, turned.v), luminous * flat.hessian.yy, 3e-6);
}

/// With the cosine for a weight the quadrature along edges is the closed form.
TEST(SweptEdges, AnyWeight) {
  const AnalyticRoom room(Walls::smooth, true);
  const HemisphereGather gather = gather_floor(room, 0.9, 0.8, {16, 50}, 1);
  const auto cosine = [](const Vec3d& w, double& value, Vec3d& slope) {
    value = w.z, slope = Vec3d(0, 0, 1) - w * w.z;
  };
  const WeightedDerivatives general = weighted_derivatives(gather, 0, cosine);
  const Jet<Rgb> closed = swept_edges(gather);
  EXPECT_NEAR(general.gradient.x, closed.translational.x.r, 1e-5);
  EXPECT_NEAR(general.gradient.y, closed.translational.y.r, 1e-5);
  EXPECT_NEAR(general.uu, closed.hessian.xx, 1e-5);
  EXPECT_NEAR(general.uv, closed.hessian.xy, 1e-5);
  EXPECT_NEAR(general.vv, closed.hessian.yy, 1e-5);
}

/// Gradients of spherical-harmonic coefficients, known beforehand: the normal component too. Strata of equal cosine are
/// coarse at the horizon, where the last of these weights is large.
TEST(SweptEdges, GradientsOfHarmonics) {
  const struct {
    const char* name;
    bool rectangle;
    double x, y;
    std::function<double(const Vec3d&)> weight;
    Vec3d truth;
    double bound;  // relative, at 64x200 with one seed
  } rows[] = {
      {"Y00", true, 0.9, 0.8, [](const Vec3d&) { return 0.28209479; }, {-0.354428, -0.142319, 0.003628}, 0.03},
      {"Y1x", true, 0.9, 0.8, [](const Vec3d& w) { return 0.48860251 * w.x; }, {0.129993, -0.141772, 0.113786}, 0.05},
      {"Y20",
       false,
       0.9,
       0.8,
       [](const Vec3d& w) { return 0.31539157 * (3 * w.z * w.z - 1); },
       {0.024993, 0.011976, 0.020657},
       0.09},
      {"Y00", false, 1.9, 1.45, [](const Vec3d&) { return 0.28209479; }, {-0.155654, -0.122530, 0.020676}, 0.02},
  };
  for (const auto& row : rows) {
    const auto weight = [&](const Vec3d& w, double& value, Vec3d& slope) {
      value = row.weight(w);
      for (int axis = 0; axis < 3; ++axis) {  // by differences; its part along w does not matter on the sphere
        Vec3d ahead = w, behind = w;
        ahead[axis] += 1e-5, behind[axis] -= 1e-5;
        slope[axis] = (row.weight(normalize(ahead)) - row.weight(normalize(behind))) / 2e-5;
      }
    };
    const AnalyticRoom room(Walls::smooth, row.rectangle);
    double sum = 0;
    constexpr int seeds = 4;
    for (int seed = 0; seed < seeds; ++seed) {
      const WeightedDerivatives d = weighted_derivatives(gather_floor(room, row.x, row.y, {64, 200}, seed), 0, weight);
      sum += length_squared(d.gradient - row.truth) / length_squared(row.truth) / seeds;
    }
    std::printf("  gradient of %s at (%g, %g): rms error %.2f%%\n", row.name, row.x, row.y, 100 * std::sqrt(sum));
    EXPECT_LT(std::sqrt(sum), row.bound) << row.name;
  }
}

}  // namespace
}  // namespace isophote::test
