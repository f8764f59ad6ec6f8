#include "isophote/validity/total_error.h"

#include <cmath>
#include <numbers>

#include "isophote/validity/tangent_axes.h"

namespace isophote {
namespace {

constexpr double pi = std::numbers::pi;

/// The tangential Hessian over E: absolute eigenvalues, and the axis of the first.
struct Curvature {
  double first, second;
  Vec3d axis, across;
};

Curvature curvature(const Jet<Rgb>& jet, const Vec3& normal, float irradiance) {
  // Axes from the signed form: of a saddle the absolute values say nothing.
  const TangentAxes axes(Sym3d(jet.hessian), Vec3d(normal));
  const double value = 0.99 * luminance(Rgbd(jet.value)) + 0.01 * irradiance;
  const double over = value > 0 ? 1 / value : 0;
  return {std::abs(axes.greater) * over, std::abs(axes.lesser) * over, axes.axis, axes.across};
}

/// One over the |n - n_i| / sqrt 2 at which a record ends: an angle of 10 degrees for a bound of 0.02 on the error, and
/// as its root.
float normal_scale(float wanted) {
  const double angle = pi / 18 * std::sqrt(wanted / 0.02);
  return static_cast<float>(1 / std::sqrt(1 - std::cos(std::min(angle, pi / 2))));
}

}  // namespace

float error_rate(const Jet<Rgb>& jet, const Vec3& normal, float irradiance) {
  const Curvature k = curvature(jet, normal, irradiance);
  return static_cast<float>(std::sqrt((k.first + k.second) / (8 * pi)));
}

Footprint total_error(const Jet<Rgb>& jet, const View& view, float wanted, const RadiusBounds& bounds, float aspect) {
  const Curvature k = curvature(jet, view.normal, view.pilot.irradiance);
  const double cap = view.scene_scale / 4;
  const double root = view.pilot.error_rate > 0 ? wanted / view.pilot.error_rate : cap * cap;
  const auto radius = [&](double curvature) {
    return curvature > 0 ? std::min(cap, std::sqrt(root) * std::pow(4 / (pi * curvature), 0.25)) : cap;
  };
  double first = radius((k.first + k.second) / 2), second = first;
  if (aspect > 1) {
    first = radius(k.first), second = radius(k.second);
    const double shorter = std::min(first, second);
    first = std::min(first, shorter * aspect), second = std::min(second, shorter * aspect);
  }
  const double longer = std::max(first, second), shorter = std::min(first, second);
  const RadiusRange range(bounds, view, wanted);
  Footprint footprint;
  footprint.normal_scale = normal_scale(wanted);
  footprint.falloff = Falloff::tent;
  footprint.smallest = range.smallest, footprint.largest = range.largest;
  footprint.radius = footprint.unscaled = static_cast<float>(longer);
  footprint.shape = Sym3(Sym3d::outer(k.axis, 1 / (first * first)) + Sym3d::outer(k.across, 1 / (second * second)) +
                         Sym3d::outer(Vec3d(view.normal), 1 / (shorter * shorter)));
  footprint.resize(footprint.radius);
  return footprint;
}

double total_error_on_line(double curvature, double eps) { return std::cbrt(3 * eps / std::abs(curvature)); }

}  // namespace isophote
