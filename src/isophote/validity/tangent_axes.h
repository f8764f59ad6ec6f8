#pragma once

#include <cmath>

#include "isophote/core/frame.h"
#include "isophote/core/sym3.h"

namespace isophote {

/// The eigenvalues of a symmetric form in the plane across the unit vector `normal`, and their axes.
struct TangentAxes {
  double greater, lesser;
  Vec3d axis, across;  ///< unit, of the greater and of the lesser

  TangentAxes(const Sym3d& form, const Vec3d& normal) {
    const Framed frame(normal);
    const double uu = quadratic_form(form, frame.u), vv = quadratic_form(form, frame.v);
    const double uv = (quadratic_form(form, frame.u + frame.v) - uu - vv) / 2;
    const double mean = (uu + vv) / 2, half = std::hypot((uu - vv) / 2, uv);
    const double angle = std::atan2(2 * uv, uu - vv) / 2, c = std::cos(angle), s = std::sin(angle);
    greater = mean + half, lesser = mean - half;
    axis = frame.u * c + frame.v * s, across = frame.v * c - frame.u * s;
  }
};

}  // namespace isophote
