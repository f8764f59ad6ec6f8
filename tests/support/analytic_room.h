#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "isophote/core/hash.h"
#include "isophote/derivatives/gather.h"
#include "support/polygon_irradiance.h"

namespace isophote::test {

/// A box of 4 x 3 x 2.5 with its floor at z = 0, whose irradiance is known to 10 digits or more. Floor black, walls and
/// ceiling emit, of constant or smoothly varying radiance; inside may float a small tilted rectangle that emits on both
/// sides and casts a shadow. Records lie on the floor.
class AnalyticRoom {
 public:
  enum class Walls { constant, smooth };
  struct Hit {
    double distance, radiance;
    Vec3d normal;  ///< facing the ray
    std::uint32_t surface;
  };

  AnalyticRoom(Walls walls, bool rectangle) : constant_(walls == Walls::constant), has_rectangle_(rectangle) {}

  /// Walls of one radiance all round, and the rectangle of another.
  static AnalyticRoom uniform(double walls, double rectangle) {
    AnalyticRoom room(Walls::constant, true);
    for (Panel& wall : room.walls_) wall.base = walls;
    room.rectangle_.base = rectangle;
    return room;
  }

  /// What a ray from inside the room meets, going up.
  Hit trace(const Vec3d& origin, const Vec3d& direction) const {
    Hit nearest{infinity, 0, {}, 0};
    for (std::uint32_t i = 0; i < walls_.size(); ++i)
      if (dot(walls_[i].normal, direction) < 0) meet(walls_[i], i, origin, direction, nearest);
    if (has_rectangle_) meet(rectangle_, static_cast<std::uint32_t>(walls_.size()), origin, direction, nearest);
    return nearest;
  }

  /// Exact irradiance. The normal may be tilted: what comes from under the floor is black.
  double irradiance(const Vec3d& x, const Vec3d& n) const { return weighted(x, n, n); }
  /// On the floor, facing up.
  double irradiance(double x, double y) const { return irradiance({x, y, 0}, {0, 0, 1}); }

  /// d irradiance / d(x, y) on the floor, by finite differences; z is left 0.
  Vec3d gradient(double x, double y) const {
    return {central_difference([&](double h) { return irradiance(x + h, y); }),
            central_difference([&](double h) { return irradiance(x, y + h); }), 0};
  }
  /// The derivative about the axes x and y as the normal turns from z; z is left 0. Turning weighs radiance L(w) by the
  /// change of the cosine, so this is the tangential part of the integral of L w, a quarter turn ahead.
  Vec3d rotational_gradient(double x, double y) const {
    return {-weighted({x, y, 0}, {0, 0, 1}, {0, 1, 0}), weighted({x, y, 0}, {0, 0, 1}, {1, 0, 0}), 0};
  }

  /// The integral of radiance times weight(w) over the directions w above the floor.
  template <class Weight>
  double integral(double x, double y, const Weight& weight) const {
    const Vec3d at{x, y, 0}, up{0, 0, 1};
    const auto from = [&](const Panel& panel, const Polygon& seen) {
      return gauss_integral(at, up, seen, [&](const Vec3d& p) {
        const Vec3d w = normalize(p - at);
        return panel.radiance(p, constant_) * weight(w) / w.z;  // without the cosine that it has
      });
    };
    double sum = 0;
    for (const Panel& wall : walls_) {
      Polygon seen = clip(wall.corners(), at, up);
      sum += from(wall, seen);
      if (!has_rectangle_) continue;
      for (const Vec3d& side : shadow_sides(at)) seen = clip(seen, at, side);
      sum -= from(wall, seen);
    }
    if (has_rectangle_) sum += from(rectangle_, rectangle_.corners());
    return sum;
  }

 private:
  /// A rectangle of radiance base (1 + swing sin(fu s + pu) cos(fv t)) at origin + s u + t v.
  struct Panel {
    Vec3d origin, u, v, normal;
    double length_u, length_v, base, swing, fu, fv, pu;

    Polygon corners() const {
      return {origin, origin + u * length_u, origin + u * length_u + v * length_v, origin + v * length_v};
    }
    double radiance(const Vec3d& y, bool constant) const {
      const double s = dot(y - origin, u), t = dot(y - origin, v);
      return constant ? base : base * (1 + swing * std::sin(fu * s + pu) * std::cos(fv * t));
    }
  };

  static Panel tilted_rectangle() {
    const Vec3d u = normalize(Vec3d{1, 0, 0.15}), slanted{-0.05, 1, 0.1};
    const Vec3d v = normalize(slanted - u * dot(u, slanted));
    return {{1.4, 1.0, 0.8}, u, v, cross(v, u), 1.0, 0.9, 0.08, 0.3, 2.0, 1.5, 0.3};
  }

  void meet(const Panel& panel, std::uint32_t id, const Vec3d& origin, const Vec3d& direction, Hit& nearest) const {
    const double slope = dot(panel.normal, direction);
    const double t = dot(panel.normal, panel.origin - origin) / slope;
    if (!(t > 0 && t < nearest.distance)) return;
    const Vec3d y = origin + direction * t, local = y - panel.origin;
    // Walls have no ends: among those that a ray faces, the nearest plane is the one it meets, at the seams too.
    const bool inside = dot(local, panel.u) >= 0 && dot(local, panel.u) <= panel.length_u && dot(local, panel.v) >= 0 &&
                        dot(local, panel.v) <= panel.length_v;
    if (id == walls_.size() && !inside) return;
    nearest = {t, panel.radiance(y, constant_), slope < 0 ? panel.normal : -panel.normal, id};
  }

  /// Normals of the planes through x and the rectangle's edges, pointing into its shadow.
  std::array<Vec3d, 4> shadow_sides(const Vec3d& x) const {
    const Polygon corners = rectangle_.corners();
    const Vec3d middle = (corners[0] + corners[2]) / 2.0 - x;
    std::array<Vec3d, 4> sides;
    for (int i = 0; i < 4; ++i) {
      sides[i] = cross(corners[i] - x, corners[(i + 1) % 4] - x);
      if (dot(sides[i], middle) < 0) sides[i] = -sides[i];
    }
    return sides;
  }

  /// The integral of radiance times weight . w over the directions w above the horizon of x with normal n.
  double weighted(const Vec3d& x, const Vec3d& n, const Vec3d& weight) const {
    double sum = 0;
    for (const Panel& wall : walls_) {
      Polygon seen = clip(wall.corners(), x, n);
      sum += weighted_from(wall, seen, x, weight);
      if (!has_rectangle_) continue;
      for (const Vec3d& side : shadow_sides(x)) seen = clip(seen, x, side);
      sum -= weighted_from(wall, seen, x, weight);
    }
    if (has_rectangle_) sum += weighted_from(rectangle_, clip(rectangle_.corners(), x, n), x, weight);
    return sum;
  }
  double weighted_from(const Panel& panel, const Polygon& seen, const Vec3d& x, const Vec3d& weight) const {
    if (constant_) return panel.base * lambert_integral(x, weight, seen);
    return gauss_integral(x, weight, seen, [&](const Vec3d& y) { return panel.radiance(y, false); });
  }

  bool constant_, has_rectangle_;
  std::vector<Panel> walls_{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 3, 2.5, 1.00, 0.4, 1.3, 0.9, 0.5},
                            {{4, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, 3, 2.5, 0.30, 0.4, 1.1, 0.7, 0.2},
                            {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 4, 2.5, 0.60, 0.4, 0.9, 0.8, 1.0},
                            {{0, 3, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, 4, 2.5, 0.15, 0.4, 1.0, 0.6, 0.0},
                            {{0, 0, 2.5}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 4, 3, 0.80, 0.4, 1.2, 1.0, 0.7}};
  Panel rectangle_ = tilted_rectangle();
};

/// A named place on the floor.
struct FloorPoint {
  const char* name;
  double x, y;
};
/// In the open, under the rectangle, and twice in its penumbra.
inline constexpr FloorPoint floor_points[] = {{"P0", 0.9, 0.8}, {"P1", 1.9, 1.45}, {"P2", 1.2, 1.3}, {"P3", 2.6, 1.9}};

/// Where in its cell a sample lies: the centre without a seed, else anywhere.
class Jitter {
 public:
  explicit Jitter(std::optional<std::uint32_t> seed) : seeded_(seed.has_value()), random_(seed.value_or(0)) {}
  Vec2 next() {
    if (!seeded_) return {0.5f, 0.5f};
    const float x = unit_float(static_cast<std::uint32_t>(random_()));
    return {x, unit_float(static_cast<std::uint32_t>(random_()))};
  }

 private:
  bool seeded_;
  std::mt19937 random_;
};

/// What a record on the floor of `room` gathers, in grey.
inline HemisphereGather gather_floor(const AnalyticRoom& room, double x, double y, Strata strata,
                                     std::optional<std::uint32_t> seed = {}) {
  HemisphereGather gather{Vec3(Vec3d(x, y, 0)), Frame(Vec3{0, 0, 1}), strata, {}};
  Jitter jitter(seed);
  for (int j = 0; j < strata.polar; ++j) {
    for (int k = 0; k < strata.azimuthal; ++k) {
      const Vec3 direction = gather.frame.to_world(strata.direction(j, k, jitter.next()));
      const AnalyticRoom::Hit hit = room.trace({x, y, 0}, Vec3d(direction));
      gather.samples.push_back({direction, static_cast<float>(hit.distance), Rgb(static_cast<float>(hit.radiance)),
                                Vec3(hit.normal), hit.surface});
    }
  }
  return gather;
}

}  // namespace isophote::test
