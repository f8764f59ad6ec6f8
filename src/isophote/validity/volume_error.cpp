#include "isophote/validity/volume_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isophote/core/eigen3.h"

namespace isophote {
namespace {

constexpr double half_turn = std::numbers::pi;

std::array<double, 3> absolute(const std::array<double, 3>& values) {
  return {std::abs(values[0]), std::abs(values[1]), std::abs(values[2])};
}
double sum(const std::array<double, 3>& values) { return values[0] + values[1] + values[2]; }

/// The integral to allow a footprint.
double allowed(const View& view, double curvature, double value, double wanted) {
  const Pilot& pilot = view.pilot;
  if (pilot.error_rate > 0) return 2 * half_turn / 15 * std::pow(wanted / pilot.error_rate, 2.5) * pilot.irradiance;
  // Over a ball: `wanted` times the value is the mean, R^2 sum |l_i| / 10.
  const double radius = std::sqrt(10 * wanted * value / curvature);
  return 4 * half_turn / 3 * radius * radius * radius * wanted * value;
}

/// The gradient of luminance, in the mean over all directions, over that itself; 0 where either is.
Vec3d relative_gradient(const VolumeJet& jet) {
  const auto& [x, y, z] = jet.translational;
  const double value = jet.value.empty() ? 0 : luminance(Rgbd(jet.value[0]));
  if (x.empty() || !(value > 0)) return {};
  return Vec3d{luminance(Rgbd(x[0])), luminance(Rgbd(y[0])), luminance(Rgbd(z[0]))} * (1 / value);
}

/// A region by its axes.
struct Region {
  std::array<Vec3d, 3> axes;
  std::array<double, 3> reach;

  Sym3d shape() const {
    Sym3d sum;
    for (int i = 0; i < 3; ++i) sum += Sym3d::outer(axes[i], 1 / (reach[i] * reach[i]));
    return sum;
  }
  /// Has it end where light has changed by as much as itself, to the first order, or at `least`.
  void end_at_change(const VolumeJet& jet, double least) {
    const Vec3d change = relative_gradient(jet);
    const double steepness = length(change);
    if (!(steepness > 0)) return;
    const Eigen3 eigen(shape() + Sym3d::outer(change * std::min(1.0, 1 / (steepness * least)), 1));
    axes = eigen.axes;
    for (int i = 0; i < 3; ++i) reach[i] = 1 / std::sqrt(eigen.values[i]);
  }
  void limit(double least, double most, double aspect) {
    most = std::min(most, aspect * std::max(least, *std::min_element(reach.begin(), reach.end())));
    for (double& r : reach) r = std::clamp(r, least, std::max(least, most));
  }
};

}  // namespace

float volume_error_rate(const VolumeJet& jet, float mean) {
  const double curvature = sum(absolute(Eigen3(Sym3d(jet.hessian)).values));
  return mean > 0 ? static_cast<float>(std::pow(curvature / static_cast<double>(mean), 0.6) / 10) : 0;
}

std::array<double, 3> volume_error_axes(std::array<double, 3> l, double eps, double aspect) {
  const double least = *std::max_element(l.begin(), l.end()) / (aspect * aspect);
  for (double& each : l) each = std::max(each, least);
  // |l_i| r_i^2 = c, and 2 pi / 15 r_1 r_2 r_3 (3 c) = eps.
  const double c = std::pow(15 * eps * std::sqrt(l[0]) * std::sqrt(l[1]) * std::sqrt(l[2]) / (6 * half_turn), 0.4);
  return {std::sqrt(c / l[0]), std::sqrt(c / l[1]), std::sqrt(c / l[2])};
}

Footprint volume_error(const VolumeJet& jet, const View& view, float wanted, const RadiusBounds& bounds, float aspect) {
  const Eigen3 eigen{Sym3d(jet.hessian)};
  std::array<double, 3> l = absolute(eigen.values);
  const double curvature = sum(l), least = smallest_radius * view.scene_scale, cap = view.scene_scale / 4;
  Region region{eigen.axes, {cap, cap, cap}};
  if (curvature > 0) {
    if (!(aspect > 1)) l.fill(curvature / 3);
    region.reach = volume_error_axes(l, allowed(view, curvature, mean_over_directions(jet), wanted), aspect);
    region.limit(least, cap, aspect);
  }
  const RadiusRange range(bounds, view, wanted);
  if (bounds.gradient) {
    region.end_at_change(jet, range.smallest);
    region.limit(least, cap, aspect);
  }
  const auto longest = static_cast<float>(*std::max_element(region.reach.begin(), region.reach.end()));
  Footprint footprint = Footprint::ball(longest);
  footprint.shape = Sym3(region.shape());
  footprint.smallest = range.smallest, footprint.largest = range.largest;
  footprint.resize(longest);
  return footprint;
}

}  // namespace isophote
