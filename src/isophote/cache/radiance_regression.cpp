#include "isophote/cache/radiance_regression.h"

#include <cmath>

#include "isophote/harmonics/rotation.h"

namespace isophote {
namespace {

/// Radii that a neighbour may be away, of the smaller of the two: where its weight reaches 0.
constexpr float neighbour_radii = 2;
/// Cosine between normals of neighbours, at least. Coefficients do not say what a tilt does to them, so that on a bent
/// surface the fit would take the bend for a change of the light.
constexpr float alike = 0.998f;

/// What a neighbour's value, and its gradient along u and v, count for in the value and in the gradient of the fit.
struct Share {
  Vec3d value, by_u, by_v;  // x: in the value; y, z: in the gradient along u and v
};

/// A neighbour as the plane meets it: at (x, y) in the record's tangent plane.
struct Point {
  double x, y, weight, of_gradient;
};

/// The inverse of the normal equations of the plane v + x gu + y gv.
Sym3d inverse_of_normal_equations(const std::vector<Point>& points) {
  Sym3d m;
  for (const Point& p : points) {
    m = m + Sym3d::outer({1, p.x, p.y}, p.weight);
    m.yy += p.of_gradient, m.zz += p.of_gradient;
  }
  const double xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz, xz = m.xy * m.yz - m.xz * m.yy;
  const double determinant = m.xx * xx + m.xy * xy + m.xz * xz;
  return Sym3d(xx, xy, xz, m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy) *
         (1 / determinant);
}

/// Adds a neighbour's coefficients, its frame turned to that of the record, by its shares.
class Sum {
 public:
  explicit Sum(int bands) : bands_(bands), value_(harmonics_count(bands)), u_(value_), v_(value_) {}

  void add(const RadianceRecord& other, double angle, const Share& share) {
    const auto turned = [&](const Coefficients& all) {
      Coefficients kept(all.begin(), all.begin() + harmonics_count(bands_));
      if (angle != 0) rotate_about_pole(bands_, angle, std::span(kept));
      return kept;
    };
    const float c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const Coefficients value = turned(other.jet.value), u = turned(other.jet.translational.x),
                       v = turned(other.jet.translational.y);
    for (std::size_t i = 0; i < value.size(); ++i) {
      const Rgbd here(value[i]), along_u(u[i] * c - v[i] * s), along_v(u[i] * s + v[i] * c);
      value_[i] += here * share.value.x + along_u * share.by_u.x + along_v * share.by_v.x;
      u_[i] += here * share.value.y + along_u * share.by_u.y + along_v * share.by_v.y;
      v_[i] += here * share.value.z + along_u * share.by_u.z + along_v * share.by_v.z;
    }
  }
  void store(RadianceJet& jet) const {
    for (std::size_t i = 0; i < value_.size(); ++i) {
      jet.value[i] = Rgb(value_[i]);
      jet.translational.x[i] = Rgb(u_[i]), jet.translational.y[i] = Rgb(v_[i]);
    }
  }

 private:
  int bands_;
  std::vector<Rgbd> value_, u_, v_;
};

}  // namespace

RadianceRegression::RadianceRegression(const RadianceCache& cache) : neighbours_(cache, neighbour_radii) {}

RadianceRecord RadianceRegression::fitted(std::uint32_t id, OpenTest open) const {
  RadianceRecord record = neighbours_.records()[id];
  if (record.jet.translational.x.empty()) return record;
  const int bands = RadianceCache::bands(record);
  auto around = neighbours_.around(neighbours_.records()[id], open);
  std::erase_if(around, [&](const auto& n) {
    return !RadianceCache::holds(*n.record, bands) || n.record->jet.translational.x.empty() ||
           dot(n.record->normal, record.normal) < alike;
  });
  const Frame frame(record.normal);
  std::vector<Point> points;
  for (const auto& n : around) {
    const float reach = neighbour_radii * std::min(record.footprint.radius, n.record->footprint.radius);
    const double near = 1 - n.distance / reach, weight = near * near * n.record->jet.rays;
    // Steps between strata are as noisy as radiance, and a function of so many bands changes as often as they turn.
    const double step = std::min<double>(n.record->jet.distances.harmonic_mean, 1e3 * reach) / bands;
    points.push_back({dot(n.offset, frame.u), dot(n.offset, frame.v), weight, weight * step * step});
  }
  const Sym3d inverse = inverse_of_normal_equations(points);
  Sum sum(bands);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const Share share{inverse * Vec3d(1, p.x, p.y) * p.weight, inverse * Vec3d(0, 1, 0) * p.of_gradient,
                      inverse * Vec3d(0, 0, 1) * p.of_gradient};
    if (!is_finite(share.value) || !is_finite(share.by_u) || !is_finite(share.by_v)) return record;
    const Frame other(around[i].record->normal);
    sum.add(*around[i].record, around[i].record->normal == record.normal ? 0 : transport_angle(other, frame), share);
  }
  sum.store(record.jet);
  return record;
}

}  // namespace isophote
