#include "isophote/derivatives/ward_heckbert_1992.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "support/analytic_room.h"
#include "support/imagined_gather.h"

namespace isophote::test {
namespace {

using Walls = AnalyticRoom::Walls;

Vec3d channel(const Gradient<Rgb>& g, int c = 0) { return {g.x[c], g.y[c], g.z[c]}; }

// Values of an independent program. Samples and results are floats and the arithmetic between them is double, so what
// can be asked is the rounding of the result, and in the gradients a little more: they are differences of rounded
// radiances.
TEST(WardHeckbert, CentreSamplesInTheSmoothRoom) {
  const AnalyticRoom room(Walls::smooth, true);
  const struct {
    Strata strata;
    double irradiance;
    Vec3d translational, exact;
  } rows[] = {{{8, 25}, 2.374581695, {-0.698744165, -0.262035858, 0}, {0.482490439, -0.991144000, 0}},
              {{32, 100}, 2.389043975, {-0.699489768, -0.296149694, 0}, {0.485255436, -1.033642862, 0}}};
  for (const auto& row : rows) {
    const Jet<Rgb> jet = ward_heckbert_1992(gather_floor(room, 0.9, 0.8, row.strata), RotationWeights::exact);
    EXPECT_NEAR(jet.value.r, row.irradiance, 2e-7 * row.irradiance);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(channel(jet.translational)[axis], row.translational[axis], 1e-6 * length(row.translational));
      EXPECT_NEAR(channel(jet.rotational)[axis], row.exact[axis], 2e-7 * length(row.exact));
    }
  }
  const Vec3d classical =
      channel(ward_heckbert_1992(gather_floor(room, 0.9, 0.8, {8, 25}), RotationWeights::classical).rotational);
  EXPECT_NEAR(classical.x, 0.405706356, 2e-7);
  EXPECT_NEAR(classical.y, -0.840745534, 2e-7);
}

/// rms over seeds of |estimate - truth| / |truth|.
double rms_error(const AnalyticRoom& room, const FloorPoint& p, Strata strata, int seeds, const Vec3d& truth,
                 const std::function<Vec3d(const HemisphereGather&)>& estimate) {
  double sum = 0;
  for (int seed = 0; seed < seeds; ++seed)
    sum += length_squared(estimate(gather_floor(room, p.x, p.y, strata, seed)) - truth) / length_squared(truth);
  return std::sqrt(sum / seeds);
}
Vec3d translational(const HemisphereGather& g) {
  return channel(ward_heckbert_1992(g, RotationWeights::exact).translational);
}
Vec3d translational_harmonic(const HemisphereGather& g) {
  return channel(ward_heckbert_1992(g, RotationWeights::exact, WallDistance::harmonic).translational);
}
Vec3d rotational(const HemisphereGather& g) {
  return channel(ward_heckbert_1992(g, RotationWeights::exact).rotational);
}
Vec3d rotational_classical(const HemisphereGather& g) {
  return channel(ward_heckbert_1992(g, RotationWeights::classical).rotational);
}

// Unbiased, and stratification makes the error fall faster than the cells' size (random directions: like its root).
TEST(WardHeckbert, IrradianceIsUnbiasedAndStratified) {
  std::printf("irradiance, rms error in %%, 16x50 and 32x100\n");
  const AnalyticRoom room(Walls::smooth, true);
  for (const FloorPoint& p : {floor_points[0], floor_points[1]}) {
    double rms[2];
    for (const int size : {0, 1}) {
      constexpr int seeds = 96;
      const double truth = room.irradiance(p.x, p.y);
      double sum = 0, squares = 0;
      for (int seed = 0; seed < seeds; ++seed) {
        const Strata strata{16 << size, 50 << size};
        const double error = irradiance(gather_floor(room, p.x, p.y, strata, seed)).value.r / truth - 1;
        sum += error, squares += error * error;
      }
      rms[size] = std::sqrt(squares / seeds);
      EXPECT_NEAR(sum / seeds, 0, 4 * rms[size] / std::sqrt(seeds)) << p.name;
    }
    std::printf("  %s %5.2f %5.2f\n", p.name, 100 * rms[0], 100 * rms[1]);
    EXPECT_LT(rms[0], 0.012) << p.name;
    EXPECT_GT(std::log2(rms[0] / rms[1]), 1.2) << p.name;
  }
}

// The error halves with the size of a cell. The bounds are errors measured with another program and other random
// numbers, with room for the spread of an rms over this many seeds.
TEST(WardHeckbert, TranslationalGradientConvergesToFirstOrder) {
  const struct {
    int point;
    bool rectangle;
    double coarse, fine, harmonic_coarse, harmonic_fine;
  } rows[] = {{0, false, 0.084, 0.042, 0.042, 0.018},
              {0, true, 0.045, 0.023, 0.030, 0.018},
              {1, true, 0.17, 0.079, 0.18, 0.086},
              {2, true, 0.081, 0.036, 0.074, 0.031}};
  std::printf("translational gradient, rms error in %%, 16x50 and 32x100, and order of convergence\n");
  for (const auto& row : rows) {
    const AnalyticRoom room(Walls::smooth, row.rectangle);
    const FloorPoint& p = floor_points[row.point];
    const Vec3d truth = room.gradient(p.x, p.y);
    const double coarse = rms_error(room, p, {16, 50}, 96, truth, translational);
    const double fine = rms_error(room, p, {32, 100}, 96, truth, translational);
    const double order = std::log2(coarse / fine);
    std::printf("  %s %-15s %5.2f %5.2f %5.2f\n", p.name, row.rectangle ? "with rectangle" : "empty", 100 * coarse,
                100 * fine, order);
    EXPECT_LT(coarse, 1.3 * row.coarse) << p.name;
    EXPECT_LT(fine, 1.3 * row.fine) << p.name;
    EXPECT_GT(order, 0.8) << p.name;
    EXPECT_LT(order, 1.5) << p.name;
    const double harmonic_coarse = rms_error(room, p, {16, 50}, 96, truth, translational_harmonic);
    const double harmonic_fine = rms_error(room, p, {32, 100}, 96, truth, translational_harmonic);
    std::printf("     one surface at its harmonic mean: %5.2f %5.2f\n", 100 * harmonic_coarse, 100 * harmonic_fine);
    EXPECT_LT(harmonic_coarse, 1.3 * row.harmonic_coarse) << p.name;
    EXPECT_LT(harmonic_fine, 1.3 * row.harmonic_fine) << p.name;
  }
}

// Exact weights converge faster than first order; classical ones lose a part of the gradient that falls with the root
// of the number of rings.
TEST(WardHeckbert, RotationalGradientAndTheBiasOfClassicalWeights) {
  const AnalyticRoom room(Walls::smooth, true);
  std::printf("rotational gradient, rms error in %%, 16x50 and 32x100: exact weights, classical weights\n");
  for (const FloorPoint& p : {floor_points[0], floor_points[1]}) {
    const Vec3d truth = room.rotational_gradient(p.x, p.y);
    const double exact16 = rms_error(room, p, {16, 50}, 96, truth, rotational);
    const double exact32 = rms_error(room, p, {32, 100}, 96, truth, rotational);
    const double classical16 = rms_error(room, p, {16, 50}, 96, truth, rotational_classical);
    const double classical32 = rms_error(room, p, {32, 100}, 96, truth, rotational_classical);
    std::printf("  %s %5.2f %5.2f   %5.2f %5.2f\n", p.name, 100 * exact16, 100 * exact32, 100 * classical16,
                100 * classical32);
    for (int seed = 0; seed < 8; ++seed)
      EXPECT_LT(length(rotational(gather_floor(room, p.x, p.y, {32, 100}, seed)) - truth), 0.02 * length(truth))
          << p.name;
    EXPECT_LT(exact32, 0.006) << p.name;
    EXPECT_GT(std::log2(exact16 / exact32), 1.2) << p.name;
    EXPECT_NEAR(std::log2(classical16 / classical32), 0.5, 0.1) << p.name;
    const Vec3d low = rotational_classical(gather_floor(room, p.x, p.y, {32, 100}, 1));
    EXPECT_NEAR(length(low) / length(truth), 1 - classical32, 0.01) << p.name;
  }
}

// E(n) = E + (n_i x n) . gradient: against irradiance at a normal turned by a degree, in the directions of both signs.
TEST(WardHeckbert, RotationalGradientPredictsTiltedNormals) {
  const AnalyticRoom room(Walls::smooth, true);
  const Vec3d x{0.9, 0.8, 0}, up{0, 0, 1};
  const Vec3d g = rotational(gather_floor(room, 0.9, 0.8, {64, 200}, 1));
  for (const Vec3d& n : {normalize(Vec3d(0.02, 0, 1)), normalize(Vec3d(-0.02, 0, 1)), normalize(Vec3d(0, 0.02, 1)),
                         normalize(Vec3d(-0.01, -0.02, 1))}) {
    const double change = room.irradiance(x, n) - room.irradiance(x, up);
    EXPECT_NEAR(dot(cross(up, n), g), change, 0.05 * std::abs(change));
  }
}

TEST(WardHeckbert, FurnaceHasNoGradients) {
  const auto room = AnalyticRoom::uniform(1.0, 1.0);
  for (const RotationWeights weights : {RotationWeights::classical, RotationWeights::exact}) {
    const Jet<Rgb> jet = ward_heckbert_1992(gather_floor(room, 1.9, 1.45, {16, 50}, 3), weights);
    EXPECT_FLOAT_EQ(jet.value.r, pi);
    EXPECT_EQ(channel(jet.translational), Vec3d());     // no step anywhere: exactly zero
    EXPECT_LT(length(channel(jet.rotational)), 1e-14);  // the azimuths of a ring cancel: zero but for their rounding
  }
}

// On a sphere of radius r about the record let half of the polar cap up to ring m be bright. There the surface form of
// the gradient, 3/r times the integral of L cos w, is (2/r) sin^3 theta_m, whichever way the half faces. The estimate
// differs by the ratio of arc to chord alone. Every ring, the first one included, has to be where it belongs.
TEST(WardHeckbert, HalfCapUpToEachRing) {
  constexpr float r = 2.5f;
  const Strata strata{8, 2000};
  for (int rings = 1; rings <= strata.polar; ++rings)
    for (const int turn : {0, 300}) {
      const HemisphereGather gather = imagine(strata, [&](int j, int k) {
        const int from_start = (k - turn + strata.azimuthal) % strata.azimuthal;
        return seen(j < rings && from_start < strata.azimuthal / 2 ? 1.0f : 0.0f, r);
      });
      const double size = 2 / r * std::pow(static_cast<double>(rings) / strata.polar, 1.5);
      const double towards = strata.azimuth(turn) + std::numbers::pi / 2;
      const Vec3d g = channel(ward_heckbert_1992(gather, RotationWeights::exact).translational);
      EXPECT_NEAR(g.x, size * std::cos(towards), 1e-5 * size) << rings << " rings";
      EXPECT_NEAR(g.y, size * std::sin(towards), 1e-5 * size) << rings << " rings";
    }
}

// Half the world bright, half dark, all at one distance: the steepest thing that split-sphere spacing prepares for.
TEST(WardHeckbert, SplitSphere) {
  for (const Strata strata : {Strata{4, 12}, Strata{16, 50}, Strata{33, 100}}) {
    const float r = 0.37f;
    const Jet<Rgb> jet =
        ward_heckbert_1992(imagine(strata, [&](int, int k) { return seen(k < strata.azimuthal / 2 ? 3.0f : 0.0f, r); }),
                           RotationWeights::exact);
    const double relative = length(channel(jet.translational)) / jet.value.r;
    EXPECT_NEAR(relative * r * std::numbers::pi / 4, 1, 3e-7);
    EXPECT_GT(jet.translational.y.r, 0);  // towards the bright half, 0 < phi < pi
    EXPECT_FLOAT_EQ(jet.distances.harmonic_mean, r);
  }
}

TEST(WardHeckbert, TurnsWithItsFrame) {
  const AnalyticRoom room(Walls::smooth, true);
  HemisphereGather gather = gather_floor(room, 1.2, 1.3, {16, 50}, 5);
  const Jet<Rgb> flat = ward_heckbert_1992(gather, RotationWeights::exact);
  for (const Vec3& normal : {Vec3{0.36f, 0.48f, -0.8f}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    gather.frame = Frame(normal);
    const Jet<Rgb> turned = ward_heckbert_1992(gather, RotationWeights::exact);
    const Framed frame(gather.frame);
    EXPECT_EQ(turned.value, flat.value);
    EXPECT_LT(length(channel(turned.translational) - frame.to_world(channel(flat.translational))), 2e-7);
    EXPECT_LT(length(channel(turned.rotational) - frame.to_world(channel(flat.rotational))), 2e-7);
    EXPECT_NEAR(dot(channel(turned.translational), Vec3d(normal)), 0, 2e-7);
  }
  // The same directions told in a frame whose azimuth starts elsewhere: cells are numbered from another one.
  constexpr int shift = 7;
  HemisphereGather renumbered = gather_floor(room, 1.2, 1.3, {16, 50}, 5);
  const HemisphereGather original = renumbered;
  const double angle = original.strata.azimuth(shift);
  renumbered.frame = Frame(Vec3(Vec3d(std::cos(angle), std::sin(angle), 0)),
                           Vec3(Vec3d(-std::sin(angle), std::cos(angle), 0)), Vec3{0, 0, 1});
  for (int j = 0; j < 16; ++j)
    for (int k = 0; k < 50; ++k) renumbered.samples[j * 50 + k] = original.at(j, (k + shift) % 50);
  const Jet<Rgb> again = ward_heckbert_1992(renumbered, RotationWeights::exact);
  EXPECT_LT(length(channel(again.translational) - channel(flat.translational)), 3e-7);
  EXPECT_LT(length(channel(again.rotational) - channel(flat.rotational)), 3e-7);
}

TEST(WardHeckbert, ChannelsDoNotMix) {
  const AnalyticRoom red(Walls::smooth, true), green(Walls::constant, true);
  const HemisphereGather r = gather_floor(red, 1.9, 1.45, {16, 50}, 2), g = gather_floor(green, 1.9, 1.45, {16, 50}, 2);
  HemisphereGather both = r;
  for (std::size_t i = 0; i < both.samples.size(); ++i)
    both.samples[i].radiance = {r.samples[i].radiance.r, g.samples[i].radiance.r, 0};
  const Jet<Rgb> jet = ward_heckbert_1992(both, RotationWeights::exact);
  const Jet<Rgb> jet_r = ward_heckbert_1992(r, RotationWeights::exact),
                 jet_g = ward_heckbert_1992(g, RotationWeights::exact);
  EXPECT_EQ(jet.value, Rgb(jet_r.value.r, jet_g.value.r, 0));
  for (const auto gradient : {&Jet<Rgb>::translational, &Jet<Rgb>::rotational}) {
    EXPECT_EQ(channel(jet.*gradient, 0), channel(jet_r.*gradient));
    EXPECT_EQ(channel(jet.*gradient, 1), channel(jet_g.*gradient));
    EXPECT_EQ(channel(jet.*gradient, 2), Vec3d());
  }
}

TEST(WardHeckbert, HarmonicMeanDistance) {
  const HemisphereGather gather = imagine({2, 4}, [](int j, int k) {
    return seen(1, k == 0 ? 0.5f : j == 0 ? 1.0f : 4.0f);
  });
  EXPECT_FLOAT_EQ(irradiance(gather).distances.harmonic_mean, 8 / (2 / 0.5f + 3 / 1.0f + 3 / 4.0f));
  EXPECT_EQ(channel(irradiance(gather).translational), Vec3d());
}

}  // namespace
}  // namespace isophote::test
