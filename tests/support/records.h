#pragma once

#include <random>

#include "isophote/validity/radius_bounds.h"
#include "isophote/validity/settle.h"
#include "isophote/validity/split_sphere.h"

namespace isophote::test {

/// Random places and directions for tests; the same ones on every machine.
class RandomPlaces {
 public:
  explicit RandomPlaces(std::uint32_t seed) : random_(seed) {}

  float number(float low, float high) { return low + (high - low) * static_cast<float>(random_()) * 0x1p-32f; }
  Vec3 point(const Vec3& low, const Vec3& high) {
    const float x = number(low.x, high.x), y = number(low.y, high.y);
    return {x, y, number(low.z, high.z)};
  }
  Rgb colour(float low, float high) {
    const Vec3 c = point({low, low, low}, {high, high, high});
    return {c.x, c.y, c.z};
  }
  Gradient<Rgb> gradient(float size) { return {colour(-size, size), colour(-size, size), colour(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = point({-1, -1, -1}, {1, 1, 1});
      if (length(v) > 0.1f && length(v) < 1) return normalize(v);
    }
  }
  /// A direction within about `spread` of `axis`.
  Vec3 direction_near(const Vec3& axis, float spread) { return normalize(axis + direction() * spread); }

 private:
  std::mt19937 random_;
};

/// A round record of order 0 and value 1.
inline Record round_record(const Vec3& position, const Vec3& normal, float radius, float normal_scale = 1) {
  Record record;
  record.position = position;
  record.normal = normal;
  record.footprint = Footprint::disk(radius, normal_scale);
  record.footprint.unscaled = radius;
  record.jet.value = Rgb(1);
  record.jet.distances.harmonic_mean = radius;
  return record;
}

inline Jet<Rgb> jet_of(float harmonic_mean, Rgb value = Rgb(1), Gradient<Rgb> gradient = {}) {
  Jet<Rgb> jet;
  jet.value = value;
  jet.translational = gradient;
  jet.distances.harmonic_mean = harmonic_mean;
  return jet;
}

/// What the metric's records do to each other.
inline void settle_bounded(const Settling& settling, std::span<const std::uint32_t> fresh, float a,
                           const RadiusBounds& bounds) {
  settle(settling, fresh, {.scale = split_sphere_radius(1, a), .slope = bounds.neighbours});
}

}  // namespace isophote::test
