#include "isophote/cache/usable_record.h"

#include <cmath>
#include <limits>

#include "isophote/core/ray.h"

namespace isophote {
namespace {

bool within(float v, float low, float high) { return low <= v && v <= high; }  // false for NaN

/// No semi-axis is longer than the radius: `shape` less the sphere of that radius, and a little for rounding, is
/// positive definite. It may be much flatter. Lookup finds records by their radius, and takes a root of the form.
bool shaped(const Footprint& f) {
  if (!(f.radius > 0 && f.radius <= std::numeric_limits<float>::max())) return false;
  constexpr double rounding = 1e-3;
  const double reach = f.radius * (1 + rounding), sphere = 1 / (reach * reach);
  const double xx = f.shape.xx - sphere, yy = f.shape.yy - sphere, zz = f.shape.zz - sphere;
  const double xy = f.shape.xy, xz = f.shape.xz, yz = f.shape.yz;
  const double minor = xx * yy - xy * xy;
  const double determinant = zz * minor - xx * yz * yz - yy * xz * xz + 2 * xy * xz * yz;
  return xx > 0 && minor > 0 && determinant > 0 && std::isfinite(determinant);
}

template <int sectors>
bool sound(const NearestBySector<sectors>& obstacles) {
  for (int i = 0; i < sectors; ++i)
    if (!within(obstacles.distance(i), 0, infinity)) return false;
  return true;
}

bool sound(const DistanceStats& distances) {
  return sound(distances.obstacles) && within(distances.harmonic_mean, 0, infinity);
}

/// Irradiance that interpolation can add up: bounded wherever the record serves, and nowhere negative at its place.
bool bounded(const Jet<Rgb>& jet, float radius) {
  constexpr float most = 1e30f;
  for (int c = 0; c < 3; ++c) {
    const auto size = [c](const Gradient<Rgb>& g) {
      return std::hypot(double{g.x[c]}, double{g.y[c]}, double{g.z[c]});
    };
    const bool fits =
        within(jet.value[c], 0, most) && size(jet.translational) * radius <= most && size(jet.rotational) <= most;
    if (!fits) return false;
  }
  return sound(jet.distances) && within(jet.gradient_error, 0, infinity);
}

/// The second-order term too is bounded wherever the record serves.
bool curved(const Record& r) {
  const Sym3& h = r.jet.hessian;
  double size = 0;
  for (const float entry : {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}) size += std::abs(double{entry});
  return within(r.curvature_scale, 0, 1e30f) &&
         size * r.curvature_scale * r.footprint.radius * r.footprint.radius * max_component(r.jet.value) <= 1e30;
}

bool usable(const Site& s) {
  const Footprint& f = s.footprint;
  constexpr float most = std::numeric_limits<float>::max();
  const bool sized = within(f.normal_scale, 0, most) && within(f.unscaled, 0, most) &&
                     within(f.smallest, 0, f.radius) && f.largest >= f.radius;
  return is_finite(s.position) && shaped(f) && sized &&
         static_cast<int>(f.falloff) <= static_cast<int>(Falloff::smooth) && f.order <= 2 &&
         within(s.gradient_scale, 0, 1);
}
bool usable_on_surface(const Site& s) {
  return usable(s) && std::abs(length(s.normal) - 1) < 1e-3f && !s.footprint.logarithmic;
}

bool bounded(const Coefficients& all, float scale) {
  for (const Rgb& each : all)
    for (int c = 0; c < 3; ++c)
      if (!within(each[c] * scale, -1e30f, 1e30f)) return false;
  return true;
}

}  // namespace

bool usable(const Record& r) {
  return usable_on_surface(r) && within(r.jet.standard_error, 0, std::numeric_limits<float>::max()) &&
         bounded(r.jet, r.footprint.radius) && curved(r);
}

bool usable(const RadianceRecord& r) {
  return usable_on_surface(r) && sound(r.jet.distances) && bounded(r.jet.value, 1) &&
         bounded(r.jet.translational.x, r.footprint.radius) && bounded(r.jet.translational.y, r.footprint.radius);
}

bool usable(const VolumeRecord& r) {
  constexpr float most = std::numeric_limits<float>::max();
  const VolumeJet& jet = r.jet;
  const Gradient<Coefficients>& g = jet.translational;
  const float radius = r.footprint.radius;
  if (!(usable(static_cast<const Site&>(r)) && r.normal == Vec3{} && r.footprint.order < 2)) return false;
  const bool summed = within(jet.standard_error, 0, most) && within(jet.gradient_error, 0, infinity) &&
                      within(jet.value_sum, 0, most) && within(jet.gradient_sum, 0, most) && sound(jet.obstacles) &&
                      within(jet.distances.harmonic_mean, 0, infinity);
  const Rgb& mean = jet.value[0];
  return summed && std::isfinite(norm(Sym3d(jet.hessian))) && mean.r >= 0 && mean.g >= 0 && mean.b >= 0 &&
         bounded(jet.value, 1) && bounded(g.x, radius) && bounded(g.y, radius) && bounded(g.z, radius);
}

bool usable(const Pilot& p) {
  constexpr float most = std::numeric_limits<float>::max();
  return within(p.error_rate, 0, most) && within(p.irradiance, 0, most) && within(p.noise_rate, 0, most);
}

}  // namespace isophote
