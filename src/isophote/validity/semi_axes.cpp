#include "isophote/validity/semi_axes.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/frame.h"

namespace isophote {

SemiAxes semi_axes(const Record& record) {
  const Framed frame{Vec3d(record.normal)};
  const Sym3d shape(record.footprint.shape);
  const double uu = quadratic_form(shape, frame.u), vv = quadratic_form(shape, frame.v);
  const double uv = (quadratic_form(shape, frame.u + frame.v) - uu - vv) / 2;
  const double mean = (uu + vv) / 2, half = std::hypot((uu - vv) / 2, uv);
  // The form is least along the longer axis. Rounding leaves of the least eigenvalue of a needle no less than this.
  const double least = std::max(mean - half, 1e-7 * mean);
  const double angle = std::atan2(2 * uv, uu - vv) / 2;
  return {static_cast<float>(1 / std::sqrt(least)), static_cast<float>(1 / std::sqrt(mean + half)),
          static_cast<float>(1 / std::sqrt(quadratic_form(shape, frame.n))),
          Vec3(frame.v * std::cos(angle) - frame.u * std::sin(angle))};
}

}  // namespace isophote
