#pragma once

#include <cmath>

#include "isophote/core/frame.h"
#include "isophote/core/sym3.h"
#include "isophote/derivatives/jet.h"
#include "isophote/sampling/strata.h"

namespace isophote {

/// A direction in the tangent plane of a gather's frame, by its azimuth.
struct Azimuth {
  double cos, sin;
};
inline Azimuth azimuth(const Strata& strata, double k) {
  const double phi = strata.azimuth(k);
  return {std::cos(phi), std::sin(phi)};
}

/// A tangential gradient in the local frame, turned into world space.
struct TangentGradient {
  Rgbd u, v;

  void add(const Azimuth& direction, const Rgbd& amount) { u += amount * direction.cos, v += amount * direction.sin; }
  /// Adds along the direction a quarter turn ahead, that of growing azimuth.
  void add_across(const Azimuth& direction, const Rgbd& amount) {
    u -= amount * direction.sin, v += amount * direction.cos;
  }

  Gradient<Rgb> to_world(const Frame& frame) const {
    const Framed f(frame);
    return {Rgb(u * f.u.x + v * f.v.x), Rgb(u * f.u.y + v * f.v.y), Rgb(u * f.u.z + v * f.v.z)};
  }
};

/// A symmetric form on the tangent plane in the local frame, turned into world space.
struct TangentHessian {
  double uu = 0, uv = 0, vv = 0;

  Sym3 to_world(const Frame& frame) const {
    const Framed f(frame);
    return Sym3(Sym3d::outer(f.u, uu - uv) + Sym3d::outer(f.v, vv - uv) + Sym3d::outer(f.u + f.v, uv));
  }
};

}  // namespace isophote
