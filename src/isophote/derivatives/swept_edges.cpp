#include "isophote/derivatives/swept_edges.h"

#include <algorithm>

#include "isophote/derivatives/standard_error.h"
#include "isophote/derivatives/tangent.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {

namespace swept {

namespace {

void set_corners(Grid& grid, const Strata& s) {
  grid.corners.clear(), grid.ring_angles.clear(), grid.wall_angles.clear(), grid.azimuths.clear();
  for (int k = 0; k < s.azimuthal; ++k) grid.azimuths.push_back(azimuth(s, k));
  const double half_turn_of_cell = std::sin(s.azimuth(0.5));
  for (int j = 0; j <= s.polar; ++j) {
    const double sin = s.sin_edge(j), cos = s.cos_edge(j);
    for (const Azimuth& a : grid.azimuths) grid.corners.push_back({sin * a.cos, sin * a.sin, cos});
    if (j < s.polar) grid.ring_angles.push_back(s.theta_edge(j + 1) - s.theta_edge(j));
    grid.wall_angles.push_back(2 * std::asin(sin * half_turn_of_cell));
  }
}

void set_planes(Grid& grid, const HemisphereGather& gather) {
  grid.planes.clear();
  const Framed frame(gather.frame);
  for (const GatherSample& s : gather.samples) {
    Plane& plane = grid.planes.emplace_back();
    plane.normal = frame.to_local(Vec3d(s.normal));
    const double slope = dot(plane.normal, frame.to_local(Vec3d(s.direction)));
    if (s.distance < infinity) plane.inverse = 1 / static_cast<double>(s.distance);
    plane.scale = slope != 0 ? 1 / slope : 0;
  }
}

}  // namespace

const Grid& grid_of(const HemisphereGather& gather) {
  thread_local Grid grid;
  set_corners(grid, gather.strata);
  set_planes(grid, gather);
  return grid;
}

}  // namespace swept

Jet<Rgb> swept_edges(const HemisphereGather& gather) {
  Jet<Rgb> jet = irradiance(gather);
  TangentGradient gradient;
  TangentHessian hessian;
  // The gradient is a sum of radiances, each times what the walls of its stratum sweep.
  struct Sweep {
    double u = 0, v = 0;
  };
  thread_local std::vector<Sweep> sweeps;
  sweeps.assign(gather.samples.size(), {});
  for_each_swept_edge(gather, [&](const SweptEdge& e) {
    const EdgeMoments s(e);
    const Rgbd step = (Rgbd(e.to->radiance) - Rgbd(e.from->radiance)) * e.sign;
    const double first = (s.s20 * e.m.z + s.s11 * e.t.z) / e.h;
    gradient.u += step * (e.c.x * first), gradient.v += step * (e.c.y * first);
    Sweep &gains = sweeps[e.to - gather.samples.data()], &loses = sweeps[e.from - gather.samples.data()];
    gains.u += e.sign * e.c.x * first, gains.v += e.sign * e.c.y * first;
    loses.u -= e.sign * e.c.x * first, loses.v -= e.sign * e.c.y * first;
    const Vec3d q = e.m * (s.s40 * e.m.z + s.s31 * e.t.z) + e.t * (s.s31 * e.m.z + s.s22 * e.t.z);
    const double second = 2 * luminance(step) / (e.h * e.h);
    hessian.uu += second * 2 * e.c.x * q.x;
    hessian.uv += second * (e.c.x * q.y + e.c.y * q.x);
    hessian.vv += second * 2 * e.c.y * q.y;
  });
  const std::span<const double> variances = stratum_variances(gather);
  double variance = 0;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    variance += variances[i] * (sweeps[i].u * sweeps[i].u + sweeps[i].v * sweeps[i].v) / 2;
  jet.gradient_error = static_cast<float>(std::sqrt(variance));
  jet.translational = gradient.to_world(gather.frame);
  jet.rotational = rotational_gradient(gather, RotationWeights::exact);
  jet.hessian = hessian.to_world(gather.frame);
  return jet;
}

}  // namespace isophote
