#include "isophote/validity/semi_axes.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/eigen3.h"
#include "isophote/validity/tangent_axes.h"

namespace isophote {

SemiAxes semi_axes(const Record& record) {
  const Sym3d shape(record.footprint.shape);
  const TangentAxes axes(shape, Vec3d(record.normal));
  // The form is least along the longer axis. Rounding leaves of the least eigenvalue of a needle no less than this.
  const double least = std::max(axes.lesser, 1e-7 * (axes.greater + axes.lesser) / 2);
  return {static_cast<float>(1 / std::sqrt(least)), static_cast<float>(1 / std::sqrt(axes.greater)),
          static_cast<float>(1 / std::sqrt(quadratic_form(shape, Vec3d(record.normal)))), Vec3(axes.across)};
}

float ball_radius(const Footprint& footprint) {
  // No semi-axis is longer than the radius, whatever rounding leaves of the least eigenvalue of a needle.
  const double radius = footprint.radius, least = 1 / (radius * radius);
  double product = 1;  // of the semi-axes over the radius
  for (const double value : Eigen3(Sym3d(footprint.shape)).values) product *= std::sqrt(least / std::max(value, least));
  return static_cast<float>(radius * std::cbrt(product));
}

}  // namespace isophote
