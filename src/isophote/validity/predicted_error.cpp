#include "isophote/validity/predicted_error.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/ray.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {
namespace {

/// Of luminance: the terms up to the second that extrapolation to (q, n) leaves out.
float left_out(const Record& record, const Vec3& q, const Vec3& n) {
  const Jet<Rgb>& jet = record.jet;
  const bool gradients = record.footprint.order > 0;
  Rgb first = jet.translational.dot(q) * (gradients ? 1 - record.gradient_scale : 1);
  if (!gradients) first += jet.rotational.dot(cross(record.normal, n));
  return luminance(first) + quadratic_form(jet.hessian, q) / 2;
}

/// The metric's measure. A footprint reaches its threshold at the rim, unless bounds have moved the rim.
float measure(const Record& record, const Vec3& q, const Vec3& n, const ErrorModel& model) {
  const Footprint& f = record.footprint;
  const float natural = f.unscaled * model.scale;
  const float distance = std::sqrt(quadratic_form(f.shape, q)) * (natural > 0 ? f.radius / natural : infinity);
  const float turned = f.normal_scale * std::sqrt(length_squared(n - record.normal) / 2);
  return model.threshold * f.combine(distance, turned);
}

}  // namespace

float predicted_error(const Record& record, const Vec3& q, const Vec3& n, const ErrorModel& model) {
  const float value = luminance(record.jet.value);
  const auto relative = [&](float error) { return error < value ? error / value : error > 0 ? 1.0f : 0.0f; };
  const float reuse = model.by_hessian ? relative(std::abs(left_out(record, q, n)))
                                       : std::pow(measure(record, q, n, model) / model.factor, 1 / model.power);
  return std::min(1.0f, std::hypot(reuse, relative(record.jet.standard_error)));
}

float predicted_error_at_rim(const Record& record, const ErrorModel& model) {
  constexpr int directions = 16;
  const SemiAxes axes = semi_axes(record);
  const Vec3 across = cross(record.normal, axes.axis);
  float sum = 0;
  for (int i = 0; i < directions; ++i) {
    const float angle = (static_cast<float>(i) + 0.5f) * (2 * pi / directions);
    const Vec3 q = axes.axis * (std::cos(angle) * axes.longer) + across * (std::sin(angle) * axes.shorter);
    sum += predicted_error(record, q, record.normal, model);
  }
  return sum / directions;
}

}  // namespace isophote
