#include "isophote/validity/volume_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/core/eigen3.h"
#include "isophote/core/frame.h"
#include "support/volume_records.h"

namespace isophote::test {
namespace {

/// Of mean radiance 2, with a Hessian of these eigenvalues along the axes of a frame.
VolumeJet curved(double u, double v, double n, const Framed& frame = {}) {
  VolumeJet jet;
  jet.value = even_radiance(Rgb(2));
  jet.hessian = Sym3(Sym3d::outer(frame.u, u) + Sym3d::outer(frame.v, v) + Sym3d::outer(frame.n, n));
  return jet;
}
View view_of(float error_rate, float mean = 2) {
  View view;
  view.scene_scale = 100;
  view.pilot = {error_rate > 0, error_rate, mean};
  return view;
}
double reach(const Footprint& f, const Vec3d& d) { return 1 / std::sqrt(quadratic_form(Sym3d(f.shape), d)); }

/// The integral over the footprint of |second-order term|, by cubes.
double integral(const Footprint& f, const Sym3& hessian) {
  constexpr int n = 160;
  const double cell = 2.0 * f.radius / n;
  double sum = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3d x{(i % n + 0.5) * cell - f.radius, (i / n % n + 0.5) * cell - f.radius,
                  (i / n / n + 0.5) * cell - f.radius};
    if (quadratic_form(Sym3d(f.shape), x) < 1) sum += std::abs(quadratic_form(Sym3d(hessian), x)) / 2;
  }
  return sum * cell * cell * cell;
}

TEST(VolumeError, AxesOfAKnownCase) {
  const auto axes = volume_error_axes({4, 1, 0.25}, 0.01, 4);
  EXPECT_NEAR(axes[0], 0.19016, 5e-6);
  EXPECT_NEAR(axes[1], 0.38033, 5e-6);
  EXPECT_NEAR(axes[2], 0.76066, 5e-6);
  const auto capped = volume_error_axes({4, 1, 0.25}, 0.01, 2);  // the least counts as 1
  EXPECT_NEAR(capped[1] / capped[0], 2, 1e-12);
  EXPECT_NEAR(capped[2] / capped[0], 2, 1e-12);
  EXPECT_GT(capped[0], axes[0]);
}

// Of all ellipsoids over which the integral's bound is eps none is larger.
TEST(VolumeError, TheEllipsoidIsTheLargest) {
  const double l[3] = {4, 1, 0.25}, eps = 0.01;
  const auto axes = volume_error_axes({4, 1, 0.25}, eps, 4);
  const auto volume_at_eps = [&](double a, double b, double c) {
    const double bound = 2 * M_PI / 15 * a * b * c * (l[0] * a * a + l[1] * b * b + l[2] * c * c);
    return a * b * c * std::pow(eps / bound, 0.6);  // scaled to eps
  };
  const double most = volume_at_eps(axes[0], axes[1], axes[2]);
  EXPECT_NEAR(most, axes[0] * axes[1] * axes[2], 1e-12);
  for (const double s : {0.9, 1.1}) {
    EXPECT_LT(volume_at_eps(s * axes[0], axes[1], axes[2]), most);
    EXPECT_LT(volume_at_eps(axes[0], s * axes[1], axes[2]), most);
    EXPECT_LT(volume_at_eps(axes[0], axes[1], s * axes[2]), most);
  }
  const double ball = std::pow(15 * eps / (2 * M_PI * (l[0] + l[1] + l[2])), 0.6);
  EXPECT_NEAR(most / ball, 1.40, 0.005);
}

// The mean over a footprint is the wanted error where a place's own rate is the mean of all: exactly of definite
// Hessians, less of others.
TEST(VolumeError, TheMeanOverTheBallIsTheWantedError) {
  const float wanted = 0.02f;
  for (const auto& [jet, ratio] :
       {std::pair{curved(3, 1, 0.5), 1.0}, {curved(-2, -2, -2), 1.0}, {curved(1, -1, 0), 0.637}}) {
    for (const bool pilot : {true, false}) {
      const Footprint f = volume_error(jet, view_of(pilot ? volume_error_rate(jet, 2) : 0), wanted, {}, 1);
      const double volume = 4 * M_PI / 3 * std::pow(f.radius, 3);
      EXPECT_NEAR(integral(f, jet.hessian) / volume / 2 / wanted, ratio, 0.01);
      EXPECT_NEAR(reach(f, {1, 0, 0}), f.radius, 1e-5 * f.radius);
      EXPECT_NEAR(reach(f, normalize(Vec3d{1, 2, -3})), f.radius, 1e-5 * f.radius);
    }
  }
}

// Two places of other rates err by the wanted error in the mean of both.
TEST(VolumeError, TheMeanOverPlacesIsTheWantedError) {
  const float wanted = 0.02f;
  const VolumeJet jets[] = {curved(3, 1, 0.5), curved(0.2, 0.3, 0.01)};
  const float rate = (volume_error_rate(jets[0], 2) + volume_error_rate(jets[1], 2)) / 2;
  double mean = 0;
  for (const VolumeJet& jet : jets) {
    const Footprint f = volume_error(jet, view_of(rate), wanted, {}, 1);
    mean += std::pow(f.radius, 2) * (jet.hessian.xx + jet.hessian.yy + jet.hessian.zz) / 10 / 2 / 2;
  }
  EXPECT_NEAR(mean / wanted, 1, 1e-5);
}

// The same eps everywhere, whatever the footprint's form.
TEST(VolumeError, EllipsoidsHaveTheBallsIntegral) {
  const Framed frame(normalize(Vec3d{0.3, 0.5, -0.8}));
  const VolumeJet jet = curved(3, 1, 0.5, frame);
  const Footprint ball = volume_error(jet, view_of(0.3f), 0.02f, {}, 1);
  const Footprint ellipsoid = volume_error(jet, view_of(0.3f), 0.02f, {}, 4);
  EXPECT_NEAR(integral(ellipsoid, jet.hessian) / integral(ball, jet.hessian), 1, 0.01);
  EXPECT_NEAR(reach(ellipsoid, frame.v) / reach(ellipsoid, frame.u), std::sqrt(3), 1e-4);
  EXPECT_NEAR(reach(ellipsoid, frame.n) / reach(ellipsoid, frame.v), std::sqrt(2), 1e-4);
  EXPECT_NEAR(reach(ellipsoid, frame.n), ellipsoid.radius, 1e-5);
  EXPECT_EQ(ellipsoid.falloff, Falloff::smooth);
  EXPECT_EQ(ellipsoid.normal_scale, 0);
}

// Along the gradient it ends where light has changed by as much as itself, across it stays as it is.
TEST(VolumeError, TheGradientBoundsItsReach) {
  VolumeJet jet = curved(0.01, 0.02, 0.01);
  jet.hessian = Sym3::scaled_identity(0.01f);
  const Footprint free = volume_error(jet, view_of(0.3f), 0.02f, {.gradient = true}, 4);
  EXPECT_FLOAT_EQ(free.radius, volume_error(jet, view_of(0.3f), 0.02f, {}, 4).radius);
  const Vec3 steep{0.6f, 0, 0.8f}, across{0, 1, 0};
  const float slope = 2 / (0.5f * free.radius);  // of a mean of 2: over half the radius
  jet.translational = {even_radiance(Rgb(slope * steep.x)), even_radiance(Rgb()), even_radiance(Rgb(slope * steep.z))};
  const Footprint bounded = volume_error(jet, view_of(0.3f), 0.02f, {.gradient = true}, 4);
  EXPECT_NEAR(reach(bounded, Vec3d(across)), free.radius, 1e-5 * free.radius);
  EXPECT_NEAR(reach(bounded, Vec3d(steep)), free.radius / std::sqrt(5), 1e-4 * free.radius);
  EXPECT_NEAR(bounded.radius, free.radius, 1e-4 * free.radius);
  EXPECT_FLOAT_EQ(volume_error(jet, view_of(0.3f), 0.02f, {}, 4).radius, free.radius);
  // No axis is longer than `aspect` times another: a ball stays one.
  for (const float aspect : {1.0f, 1.5f}) {
    const Footprint f = volume_error(jet, view_of(0.3f), 0.02f, {.gradient = true}, aspect);
    EXPECT_NEAR(reach(f, Vec3d(steep)), free.radius / std::sqrt(5), 1e-4 * free.radius);
    EXPECT_NEAR(reach(f, Vec3d(across)), aspect * free.radius / std::sqrt(5), 1e-4 * free.radius);
  }
  // No thinner than lower bounds allow.
  const Footprint thick = volume_error(jet, view_of(0.3f), 0.02f, {.min_length = free.radius, .gradient = true}, 4);
  EXPECT_NEAR(reach(thick, Vec3d(steep)), free.radius / std::sqrt(2), 1e-4 * free.radius);
}

TEST(VolumeError, FlatBlackAndBounded) {
  const VolumeJet flat = curved(0, 0, 0);
  for (const float aspect : {1.0f, 4.0f}) {
    EXPECT_FLOAT_EQ(volume_error(flat, view_of(1), 0.02f, {}, aspect).radius, 25);
    VolumeJet black = curved(1, -1, 2);
    black.value = even_radiance(Rgb());
    EXPECT_FLOAT_EQ(volume_error(black, view_of(0), 0.02f, {}, aspect).radius, 100 * smallest_radius);
    EXPECT_FLOAT_EQ(volume_error(black, view_of(1, 0), 0.02f, {}, aspect).radius, 100 * smallest_radius);
    const Footprint f = volume_error(black, view_of(1), 0.02f, {}, aspect);  // the picture is not black
    EXPECT_TRUE(std::isfinite(f.shape.xx) && f.shape.xx > 0 && f.radius > 0.01f);
    View view = view_of(1);
    view.pixel = 0.01f;
    EXPECT_FLOAT_EQ(volume_error(curved(1e12, 1e12, 1e12), view, 0.02f, {.min_pixels = 1.5f}, aspect).radius, 0.015f);
    EXPECT_FLOAT_EQ(volume_error(flat, view, 0.02f, {.max_pixels = 30}, aspect).radius, 0.3f);
  }
  const Footprint f = volume_error(curved(1, 0, 0), view_of(1), 0.02f, {}, 4);  // along two axes nothing bends
  EXPECT_NEAR(f.radius / reach(f, {1, 0, 0}), 4, 1e-4);
  EXPECT_EQ(volume_error_rate(flat, 2), 0);
  EXPECT_EQ(volume_error_rate(curved(1, 1, 1), 0), 0);
}

}  // namespace
}  // namespace isophote::test
