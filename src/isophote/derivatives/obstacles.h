#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "isophote/core/frame.h"
#include "isophote/core/vec.h"

namespace isophote {

struct HemisphereGather;
struct SphereGather;

/// Distances of the nearest things by sectors of directions, each rounded down to the upper half of a float's bits.
template <int count>
struct NearestBySector {
  static constexpr int sectors = count;
  static constexpr std::uint16_t nothing = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >> 16;

  std::array<std::uint16_t, sectors> nearest = filled(nothing);  ///< bits
  std::uint16_t least = nothing;                                 ///< of those

  float distance(int sector) const { return from_bits(nearest[sector]); }
  /// Takes note of something at `distance` >= 0.
  void meet(int sector, float distance) {
    const auto bits = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(distance) >> 16);
    nearest[sector] = std::min(nearest[sector], bits);  // bits of floats that are not negative are in their order
    least = std::min(least, nearest[sector]);
  }

  bool operator==(const NearestBySector&) const = default;

 protected:
  /// Does what lies at `q` lie farther than a thing at `distance`? What was seen may reach nearer than where rays,
  /// which are few, met it: the margin is for that.
  static bool beyond(const Vec3& q, float distance) {
    constexpr float margin = 0.8f;
    return length_squared(q) > margin * margin * distance * distance;
  }
  bool beyond_all(const Vec3& q) const { return beyond(q, from_bits(least)); }

 private:
  static float from_bits(std::uint16_t bits) { return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16); }
  static constexpr std::array<std::uint16_t, sectors> filled(std::uint16_t bits) {
    std::array<std::uint16_t, sectors> all{};
    all.fill(bits);
    return all;
  }
};

/// The nearest things a record sees, by azimuth about its normal: all that lookup has to know to tell where something
/// may stand between the record and a query. Each sector holds a distance along the tangent plane or above it,
/// whichever is greater.
struct Obstacles : NearestBySector<16> {
  /// The sector of a direction in the tangent plane. Quarter turns are cut evenly in y / (|x| + |y|) instead of the
  /// angle: all sectors are about as wide (18 to 27 degrees), for the price of a division.
  static int sector(float x, float y) {
    constexpr int half = sectors / 2;
    const float sum = std::abs(x) + std::abs(y);
    if (!(sum > 0)) return 0;
    const float along = (x >= 0 ? y : -y) / sum;  // from -1 to 1 over each half turn
    const int step = std::min(static_cast<int>((along + 1) * (half / 2)), half - 1);
    return x >= 0 ? step : step + half;
  }

  /// May something stand between the record and what lies at `q` from it?
  bool before(const Vec3& q, const Vec3& normal) const {
    if (!beyond_all(q)) return false;  // as nearly always
    // What lies over the record may be hidden by what hangs between, in whichever sector that was seen.
    const float height = dot(q, normal);
    if (2 * height * height > length_squared(q)) return true;
    const Frame frame(normal);
    return beyond(q, distance(sector(dot(q, frame.u), dot(q, frame.v))));
  }
};

/// The same about a place in a medium: sectors are quarters of the faces of a cube with the world's axes.
struct ObstaclesAround : NearestBySector<24> {
  static int sector(const Vec3& d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const int signs = (d.x > 0) | (d.y > 0) << 1 | (d.z > 0) << 2;
    return axis * 8 + signs;
  }
  bool before(const Vec3& q) const { return beyond_all(q) && beyond(q, distance(sector(q))); }
};

/// What the gather saw, each sample counting for the sectors of its own stratum and of the two beside it: a thing that
/// stands between rays is met by neither, but it is seldom thinner and shorter than they are apart.
Obstacles obstacles(const HemisphereGather& gather);
ObstaclesAround obstacles(const SphereGather& gather);

}  // namespace isophote
