#pragma once

#include <cmath>
#include <functional>

#include "isophote/derivatives/jet.h"
#include "support/analytic_room.h"

namespace isophote::test {

/// A place on the floor of a room, with the derivatives of its irradiance known beforehand.
struct KnownPoint {
  const char* name;
  AnalyticRoom (*room)();
  double x, y;
  double gx, gy;
  double xx, xy, yy;
};
inline AnalyticRoom empty() { return {AnalyticRoom::Walls::smooth, false}; }
inline AnalyticRoom occluded() { return {AnalyticRoom::Walls::smooth, true}; }
inline AnalyticRoom constant() { return {AnalyticRoom::Walls::constant, true}; }
inline AnalyticRoom uniform() { return AnalyticRoom::uniform(1, 0.1); }
inline constexpr KnownPoint known_points[] = {
    {"P0 empty", empty, 0.9, 0.8, -0.49848072, -0.15857032, 0.428064, -0.056868, -0.222373},
    {"P1 empty", empty, 1.9, 1.45, -0.25588382, -0.21736148, 0.075287, 0.105955, -0.179683},
    {"P0 with rectangle", occluded, 0.9, 0.8, -0.68797485, -0.29598643, 0.131824, -0.426007, -0.251101},
    {"P1 with rectangle", occluded, 1.9, 1.45, -0.24994298, -0.26435470, 1.510418, -0.041752, 1.387961},
    {"P2 with rectangle", occluded, 1.2, 1.3, -0.93287732, -0.32691458, -0.277978, -0.174089, 0.433899},
    {"P1, constant walls", constant, 1.9, 1.45, -0.17127526, -0.18296331, 1.462238, -0.008175, 1.343090},
    {"P3, constant walls", constant, 2.6, 1.9, 0.14217830, 0.00070783, -0.130181, -0.421810, 0.009483},
    {"P1, uniform walls", uniform, 1.9, 1.45, 0.03209149, -0.00084179, 1.7768586, -0.0021350, 1.9465710}};

struct DerivativeErrors {
  double gradient, hessian;  ///< rms over seeds, relative to the truth's size
};

inline DerivativeErrors rms_errors(const KnownPoint& p, Strata strata, int seeds,
                                   const std::function<Jet<Rgb>(const HemisphereGather&)>& estimate) {
  const AnalyticRoom room = p.room();
  double gradient = 0, hessian = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Jet<Rgb> jet = estimate(gather_floor(room, p.x, p.y, strata, seed));
    gradient += std::pow(jet.translational.x.r - p.gx, 2) + std::pow(jet.translational.y.r - p.gy, 2);
    hessian += std::pow(jet.hessian.xx - p.xx, 2) + 2 * std::pow(jet.hessian.xy - p.xy, 2) +
               std::pow(jet.hessian.yy - p.yy, 2);
  }
  return {std::sqrt(gradient / seeds / (p.gx * p.gx + p.gy * p.gy)),
          std::sqrt(hessian / seeds / (p.xx * p.xx + 2 * p.xy * p.xy + p.yy * p.yy))};
}

/// What an estimator may err at 16x50 and 32x100 strata.
struct ErrorBounds {
  int point;
  DerivativeErrors coarse, fine;
};

template <std::size_t N>
void expect_errors_below(const char* name, const ErrorBounds (&rows)[N],
                         const std::function<Jet<Rgb>(const HemisphereGather&)>& estimate) {
  std::printf("%s: rms error of gradient / Hessian in %%, 16x50 and 32x100\n", name);
  for (const ErrorBounds& row : rows) {
    const KnownPoint& p = known_points[row.point];
    const DerivativeErrors coarse = rms_errors(p, {16, 50}, 32, estimate);
    const DerivativeErrors fine = rms_errors(p, {32, 100}, 32, estimate);
    std::printf("  %-18s %5.2f / %5.2f   %5.2f / %5.2f\n", p.name, 100 * coarse.gradient, 100 * coarse.hessian,
                100 * fine.gradient, 100 * fine.hessian);
    EXPECT_LT(coarse.gradient, 1.3 * row.coarse.gradient) << p.name;
    EXPECT_LT(coarse.hessian, 1.3 * row.coarse.hessian) << p.name;
    EXPECT_LT(fine.gradient, 1.3 * row.fine.gradient) << p.name;
    EXPECT_LT(fine.hessian, 1.3 * row.fine.hessian) << p.name;
  }
}

/// Everything one sees is of one radiance, at any distance.
inline HemisphereGather furnace(const AnalyticRoom& room, Strata strata, const Rgb& radiance) {
  HemisphereGather gather = gather_floor(room, 0.9, 0.8, strata, 1);
  for (GatherSample& s : gather.samples) s.radiance = radiance;
  return gather;
}

}  // namespace isophote::test
