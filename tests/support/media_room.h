#pragma once

#include <optional>
#include <random>
#include <vector>

#include "isophote/derivatives/sphere_gather.h"
#include "support/analytic_room.h"
#include "support/single_scattering.h"

namespace isophote::test {

/// A box [-1, 1] x [-1, 1] x [0, 2] of emitting walls full of a medium, with a plate in it that emits on both sides.
/// The wall x = 1 has a window, brighter than the rest; through it the sun shines and makes a shaft in the medium, in
/// which the plate casts a shadow. The light of the shaft that the medium scatters once, known in closed form, is what
/// the medium emits here; surfaces have none of the sun.
class MediaRoom {
 public:
  struct Hit {
    double distance;
    Vec3d normal;  ///< facing the ray
    std::uint32_t surface;
  };

  AnalyticMedium medium;
  HenyeyGreenstein phase;
  double sun = 8;  ///< irradiance across its direction

  MediaRoom(AnalyticMedium::Kind kind, double g) : medium(kind), phase{g} {}

  static Vec3d sun_direction() { return normalize(Vec3d{-1, 0.15, -0.7}); }

  Hit trace(const Vec3d& x, const Vec3d& w) const {
    Hit nearest{infinity, {}, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(w[axis]) < 1e-14) continue;
      const double wall = axis == 2 ? (w.z > 0 ? 2 : 0) : std::copysign(1, w[axis]), t = (wall - x[axis]) / w[axis];
      if (!(t < nearest.distance)) continue;
      nearest = {t, {}, static_cast<std::uint32_t>(2 * axis + (w[axis] > 0))};
      nearest.normal[axis] = -std::copysign(1, w[axis]);
    }
    const double t = (plate_x - x.x) / w.x;
    if (std::abs(w.x) > 1e-14 && t > 1e-9 && t < nearest.distance && inside(x + w * t, plate))
      nearest = {t, {-std::copysign(1, w.x), 0, 0}, plate_id};
    return nearest;
  }

  double surface_radiance(const Vec3d& y, std::uint32_t surface) const {
    if (surface == plate_id) return 0.1;
    if (surface == 1 && inside(y, window)) return 3;
    return 0.5 + 0.3 * std::sin(2 * y.x + 1) * std::cos(1.5 * y.y) + 0.2 * y.z * (1 + 0.5 * y.y);
  }

  /// sigma_s times the sun's light scattered at y towards -w.
  double source(const Vec3d& y, const Vec3d& w) const { return is_lit(y) ? lit_source(y, w) : 0; }

  /// What the medium from a to b along w adds to the radiance at x.
  double shell_radiance(const Vec3d& x, const Vec3d& w, double a, double b) const {
    double sum = 0;
    for (const Interval& lit : lit_intervals(x, w, {a, b}))
      GaussRule<8>::get().integrate(lit.from, lit.to, [&](double t, double weight) {
        sum += weight * medium.transmittance(x, w, t) * lit_source(x + w * t, w);
      });
    return sum;
  }

  /// Of the logarithm of the source at depth t along w, as x moves and the place stays.
  Vec3d source_log_gradient(const Vec3d& w, double t) const {
    const SeenPlace place({}, w * t);
    return place.phase(phase, sun_direction()).log_gradient;
  }

 private:
  struct Rectangle {
    double y0, y1, z0, z1;
  };
  struct Interval {
    double from, to;
    bool empty() const { return !(from < to); }
    /// Where low < a + b t < high.
    Interval clipped(double a, double b, double low, double high) const {
      if (std::abs(b) < 1e-14) return a > low && a < high ? *this : Interval{1, 0};
      const double u = (low - a) / b, v = (high - a) / b;
      return {std::max(from, std::min(u, v)), std::min(to, std::max(u, v))};
    }
  };
  /// Up to two intervals.
  struct Intervals {
    std::array<Interval, 2> all{};
    int count = 0;
    void add(const Interval& i) {
      if (!i.empty()) all[count++] = i;
    }
    const Interval* begin() const { return all.data(); }
    const Interval* end() const { return all.data() + count; }
  };

  static constexpr std::uint32_t plate_id = 6;
  static constexpr double plate_x = 0.3;
  static constexpr Rectangle plate{-0.7, 0.1, 0.4, 1.1}, window{-0.3, 0.3, 1.2, 1.8};

  static bool inside(const Vec3d& y, const Rectangle& r) {
    return y.y > r.y0 && y.y < r.y1 && y.z > r.z0 && y.z < r.z1;
  }

  /// The part of an interval along a ray which, along the sun's rays, lies before a rectangle at a given x.
  static Interval behind(const Vec3d& x, const Vec3d& w, Interval i, double at_x, const Rectangle& r) {
    const Vec3d d = sun_direction();
    const double ky = d.y / d.x, kz = d.z / d.x;
    i = i.clipped(x.y - (x.x - at_x) * ky, w.y - w.x * ky, r.y0, r.y1);
    return i.clipped(x.z - (x.x - at_x) * kz, w.z - w.x * kz, r.z0, r.z1);
  }
  static Intervals lit_intervals(const Vec3d& x, const Vec3d& w, const Interval& all) {
    Intervals lit;
    const Interval shaft = behind(x, w, all, 1, window);
    if (shaft.empty()) return lit;
    const Interval shadow = behind(x, w, shaft.clipped(x.x, w.x, -1e9, plate_x), plate_x, plate);
    if (shadow.empty()) {
      lit.add(shaft);
      return lit;
    }
    lit.add({shaft.from, shadow.from});
    lit.add({shadow.to, shaft.to});
    return lit;
  }
  static bool is_lit(const Vec3d& y) { return lit_intervals(y, {0, 0, 1}, {-1e-9, 1e-9}).count > 0; }

  double lit_source(const Vec3d& y, const Vec3d& w) const {
    constexpr double albedo = 0.8;
    const Vec3d d = sun_direction();
    return albedo * medium.extinction(y) * sun * medium.transmittance(y, -d, (y.x - 1) / d.x) * phase(-dot(d, w));
  }
};

/// How the rays of a gather are cut: the first shell ends at 0.03, the last beyond the farthest corner, each thicker
/// than the one before by the same factor. Shells are exact and the depth of each is the geometric mean of its ends;
/// or, with a seed, each is looked at in one place, by the same share of it for all rays.
struct MediaShells {
  std::vector<float> ends;
  std::vector<double> shares{};

  explicit MediaShells(int count, std::optional<std::uint32_t> seed = {}) {
    std::mt19937 random(seed.value_or(0));
    for (int l = 0; l < count; ++l) {
      ends.push_back(static_cast<float>(0.03 * std::pow(3.5 / 0.03, static_cast<double>(l) / (count - 1))));
      if (seed) shares.push_back(static_cast<double>(unit_float(static_cast<std::uint32_t>(random()))));
    }
  }
  double depth(std::size_t l, double begin, double end) const {
    if (!shares.empty()) return begin + shares[l] * (end - begin);
    return begin > 0 ? std::sqrt(begin * end) : end / 2;
  }
};

/// One ray and its layers, in grey. `axes` are those of the gather, in the room.
inline GatherSample gather_ray(const MediaRoom& room, const Vec3d& x, const Framed& axes, const Vec3& direction,
                               const MediaShells& shells, std::vector<GatherLayer>& layers) {
  const Vec3d w = axes.to_world(Vec3d(direction));
  const MediaRoom::Hit hit = room.trace(x, w);
  GatherSample sample{direction, static_cast<float>(hit.distance), {}, Vec3(axes.to_local(hit.normal)), hit.surface};
  const auto add = [&](double radiance, double depth, const Vec3d& slope) {
    const Vec3 g(axes.to_local(slope));
    layers.push_back({Rgb(static_cast<float>(radiance)), static_cast<float>(depth), {Rgb(g.x), Rgb(g.y), Rgb(g.z)}});
    sample.radiance += layers.back().radiance;
  };
  const double r = hit.distance;
  add(room.medium.transmittance(x, w, r) * room.surface_radiance(x + w * r, hit.surface), r,
      room.medium.log_gradient(x, w, r));
  double begin = 0;
  for (std::size_t l = 0; l < shells.ends.size(); ++l) {
    const double end = std::min(static_cast<double>(shells.ends[l]), r);
    const double depth = begin < end ? shells.depth(l, begin, end) : r;
    double radiance = 0;
    if (begin < end && shells.shares.empty()) radiance = room.shell_radiance(x, w, begin, end);
    if (begin < end && !shells.shares.empty())
      radiance = (end - begin) * room.medium.transmittance(x, w, depth) * room.source(x + w * depth, w);
    add(radiance, depth,
        radiance > 0 ? room.medium.log_gradient(x, w, depth) + room.source_log_gradient(w, depth) : Vec3d());
    begin = static_cast<double>(shells.ends[l]);
  }
  return sample;
}

/// Axes for gathers over the sphere, of which none is one of the room's: its edges would lie along walls of cells.
inline Framed turned_axes() {
  const Vec3d n = normalize(Vec3d{0.31, 0.23, 0.92}), u = normalize(cross(Vec3d{0, 1, 0.2}, n));
  return {u, cross(n, u), n};
}

/// In turned axes, as are all directions and derivatives of what is made of it.
inline SphereGather gather_sphere(const MediaRoom& room, const Vec3d& x, SphereStrata strata, const MediaShells& shells,
                                  std::optional<std::uint32_t> seed = {}) {
  const Framed axes = turned_axes();
  SphereGather gather{{}, strata, static_cast<int>(shells.ends.size()), shells.ends, {}, {}, {}};
  Jitter jitter(seed);
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) {
      const Vec3 direction = strata.direction(j, k, jitter.next());
      gather.samples.push_back(gather_ray(room, x, axes, direction, shells, gather.layers));
      gather.sources.push_back(Rgb(static_cast<float>(room.source(x, axes.to_world(Vec3d(direction))))));
    }
  return gather;
}

inline SphereGather gather_sphere(const MediaRoom& room, const Vec3d& x, SphereStrata strata, int shells,
                                  std::optional<std::uint32_t> seed = {}) {
  return gather_sphere(room, x, strata, MediaShells(shells), seed);
}

inline HemisphereGather gather_floor(const MediaRoom& room, double x, double y, Strata strata, int shell_count,
                                     std::optional<std::uint32_t> seed = {}) {
  const MediaShells shells(shell_count);
  HemisphereGather gather{Vec3(Vec3d(x, y, 0)), Frame(Vec3{0, 0, 1}), strata, {}, shell_count};
  Jitter jitter(seed);
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) {
      const Vec3 direction = gather.frame.to_world(strata.direction(j, k, jitter.next()));
      gather.samples.push_back(gather_ray(room, {x, y, 0}, Framed(), direction, shells, gather.layers));
      gather.sources.push_back(Rgb(static_cast<float>(room.source({x, y, 0}, Vec3d(direction)))));
    }
  return gather;
}

}  // namespace isophote::test
