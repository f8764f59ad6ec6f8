#include "comparison/occluded_plane.h"

#include "isophote/sampling/sampler.h"

namespace isophote::bench {
namespace {

using test::Polygon;

/// What of `seen` lies, seen from p, behind or before the convex `occluder`.
Polygon in_shadow(Polygon seen, const Vec3d& p, const Polygon& occluder) {
  const Vec3d middle = (occluder[0] + occluder[2]) / 2.0 - p;
  for (std::size_t i = 0; i < occluder.size(); ++i) {
    Vec3d side = cross(occluder[i] - p, occluder[(i + 1) % occluder.size()] - p);
    if (dot(side, middle) < 0) side = -side;
    seen = test::clip(seen, p, side);
  }
  return seen;
}

double irradiance_of(const Polygon& polygon, const Vec3d& p) {
  return polygon.size() < 3 ? 0 : test::lambert_integral(p, {0, 0, 1}, polygon);
}

}  // namespace

test::Polygon OccludedPlane::Square::corners() const {
  const double c = side / 2 * std::cos(turn), s = side / 2 * std::sin(turn);
  const Vec3d middle{x, y, height}, u{c, s, 0}, v{-s, c, 0};
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

bool OccludedPlane::Square::contains(double px, double py) const {
  const double c = std::cos(turn), s = std::sin(turn), dx = px - x, dy = py - y;
  return std::abs(c * dx + s * dy) <= side / 2 && std::abs(c * dy - s * dx) <= side / 2;
}

double OccludedPlane::irradiance(double x, double y) const {
  const Vec3d p{x, y, 0};
  const Polygon low = low_.corners(), high = high_.corners();
  /// The part of a polygon's irradiance that neither square hides.
  const auto visible = [&](const Polygon& polygon) {
    const Polygon behind_low = in_shadow(polygon, p, low);
    return irradiance_of(polygon, p) - irradiance_of(behind_low, p) - irradiance_of(in_shadow(polygon, p, high), p) +
           irradiance_of(in_shadow(behind_low, p, high), p);
  };
  const double hidden = irradiance_of(low, p) + irradiance_of(high, p) - irradiance_of(in_shadow(low, p, high), p);
  return dim * (std::numbers::pi - hidden) + (bright - dim) * visible(emitter_.corners());
}

OccludedPlane::Derivatives OccludedPlane::derivatives(double x, double y) const {
  constexpr double h = 1e-3;
  const auto at = [&](int i, int k) { return irradiance(x + i * h, y + k * h); };
  const double middle = at(0, 0), left = at(-1, 0), right = at(1, 0), lower = at(0, -1), upper = at(0, 1);
  return {(right - left) / (2 * h), (upper - lower) / (2 * h), (right - 2 * middle + left) / (h * h),
          (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * h * h), (upper - 2 * middle + lower) / (h * h)};
}

HemisphereGather OccludedPlane::gather(double x, double y, Strata strata, std::uint64_t key) const {
  HemisphereGather gather{Vec3(Vec3d(x, y, 0)), Frame(Vec3{0, 0, 1}), strata, {}};
  for (int j = 0; j < strata.polar; ++j) {
    for (int k = 0; k < strata.azimuthal; ++k) {
      Sampler sampler(Purpose::test, key, 0, static_cast<std::uint32_t>(gather.samples.size()));
      const Vec3d direction(gather.frame.to_world(strata.direction(j, k, sampler.next2())));
      const auto meets = [&](const Square& square) {
        const double t = square.height / direction.z;
        return square.contains(x + t * direction.x, y + t * direction.y);
      };
      const std::uint32_t surface = meets(low_) ? 2 : meets(high_) ? 3 : meets(emitter_) ? 1 : 0;
      const double height = surface == 2 ? low_.height : surface == 3 ? high_.height : ceiling;
      const double radiance = surface == 0 ? dim : surface == 1 ? bright : 0;
      gather.samples.push_back({Vec3(direction),
                                static_cast<float>(height / direction.z),
                                Rgb(static_cast<float>(radiance)),
                                {0, 0, -1},
                                surface});
    }
  }
  return gather;
}

}  // namespace isophote::bench
