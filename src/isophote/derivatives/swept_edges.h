#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "isophote/core/check.h"
#include "isophote/derivatives/edge.h"
#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"
#include "isophote/derivatives/tangent.h"

namespace isophote {

/// Irradiance with its gradients and Hessian by swept edges (docs/theory.md): each wall between two strata is a
/// straight segment in space on the nearer surface, and moves over the hemisphere as the record moves; what it sweeps
/// changes from one radiance to the other. Rotational gradient with exact stratum weights. Knows occlusion; in a
/// furnace all derivatives are exactly 0.
Jet<Rgb> swept_edges(const HemisphereGather& gather);

/// A wall between two strata as a segment in the gather's local frame (the record at the origin, z along the normal).
struct SweptEdge : Edge {
  double sign = 1;  ///< 1 where `c` points from stratum `from` into stratum `to`, else -1
  const GatherSample *from = nullptr, *to = nullptr;
};

namespace swept {

/// Inverse distance of a sample's tangent plane along the unit vector `w`, no more than twice as far or near as the
/// sample; 0 for the sky. All in the local frame.
struct Plane {
  Vec3d normal;
  double inverse = 0, scale = 0;  // 1 / distance, 1 / (normal . direction)

  double along(const Vec3d& w) const { return inverse * std::clamp(dot(normal, w) * scale, 0.5, 2.0); }
};

/// Depths of two neighbours of which one is more than so many times as far are a step, else one surface.
inline constexpr double step_ratio = 1.3;

/// Corners of the strata and the angles between them, and the planes of the samples.
struct Grid {
  std::vector<Azimuth> azimuths;
  std::vector<Vec3d> corners;                    // (polar + 1) x azimuthal
  std::vector<double> ring_angles, wall_angles;  // across ring j; of the wall before it
  std::vector<Plane> planes;
};

/// In memory of the calling thread, which its next call reuses.
const Grid& grid_of(const HemisphereGather& gather);

/// Inverse depths of the wall between two samples in two directions: on the nearer surface at a step, between both
/// elsewhere.
inline std::array<double, 2> inverse_depths(const Plane& p, const Plane& q, const Vec3d& wa, const Vec3d& wb) {
  const bool p_nearer = p.inverse > q.inverse;
  const Plane &near = p_nearer ? p : q, &far = p_nearer ? q : p;
  if (near.inverse > step_ratio * far.inverse) return {near.along(wa), near.along(wb)};
  return {(near.along(wa) + far.along(wa)) / 2, (near.along(wb) + far.along(wb)) / 2};
}

}  // namespace swept

/// Calls visit(edge) for each wall between two strata of different radiance, of which not both are sky.
template <class Visit>
void for_each_swept_edge(const HemisphereGather& gather, Visit&& visit) {
  const Strata& s = gather.strata;
  ISOPHOTE_CHECK(gather.samples.size(), ==, static_cast<std::size_t>(s.size()));
  const swept::Grid& grid = swept::grid_of(gather);
  const auto wall = [&](std::size_t from, std::size_t to, std::size_t corner_a, std::size_t corner_b, double angle,
                        double sign) {
    const GatherSample &p = gather.samples[from], &q = gather.samples[to];
    if (p.radiance == q.radiance || p.surface == GatherSample::own_surface || q.surface == GatherSample::own_surface)
      return;
    const Vec3d &wa = grid.corners[corner_a], &wb = grid.corners[corner_b];
    const auto [ia, ib] = swept::inverse_depths(grid.planes[from], grid.planes[to], wa, wb);
    if (!(ia > 0 && ib > 0)) return;
    SweptEdge edge;
    if (!edge.set(wa / ia, wb / ib, angle)) return;
    edge.sign = sign, edge.from = &p, edge.to = &q;
    visit(edge);
  };
  const auto n = static_cast<std::size_t>(s.azimuthal);
  for (std::size_t j = 0; j < static_cast<std::size_t>(s.polar); ++j)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t here = j * n + k;
      if (j > 0) wall(here - n, here, here, j * n + (k + 1) % n, grid.wall_angles[j], -1);
      wall(j * n + (k + n - 1) % n, here, here, here + n, grid.ring_angles[j], 1);
    }
}

/// The gradient (all three components) and the tangential Hessian of F = integral of L(w) W(w) dw, for one channel and
/// any smooth weight, in the local frame. `weight(w, value, slope)` sets W and its gradient on the sphere.
struct WeightedDerivatives {
  Vec3d gradient;
  double uu = 0, uv = 0, vv = 0;
};
template <class Weight>
WeightedDerivatives weighted_derivatives(const HemisphereGather& gather, int channel, Weight&& weight) {
  constexpr std::array<double, 3> nodes{-0.7745966692414834, 0, 0.7745966692414834},
      shares{5 / 18.0, 4 / 9.0, 5 / 18.0};
  WeightedDerivatives sum;
  for_each_swept_edge(gather, [&](const SweptEdge& e) {
    const double step = e.sign * (static_cast<double>(e.to->radiance[channel]) - e.from->radiance[channel]);
    const double middle = std::atan2(e.sin_a, e.cos_a) + e.angle / 2;
    double first = 0;
    Vec3d second;
    for (int i = 0; i < 3; ++i) {
      const double al = middle + nodes[i] * e.angle / 2, c = std::cos(al), share = shares[i] * e.angle;
      const Vec3d w = e.m * c + e.t * std::sin(al);
      double value;
      Vec3d slope;
      weight(w, value, slope);
      first += share * c * value;
      second += (w * (3 * value) - slope) * (share * c * c);
    }
    sum.gradient += e.c * (step * first / e.h);
    const double k = step / (e.h * e.h);
    sum.uu += k * e.c.x * second.x;
    sum.uv += k * (e.c.x * second.y + e.c.y * second.x) / 2;
    sum.vv += k * e.c.y * second.y;
  });
  return sum;
}

}  // namespace isophote
