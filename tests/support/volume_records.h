#pragma once

#include <cmath>
#include <numbers>

#include "isophote/validity/volume_record.h"

namespace isophote::test {

/// Radiance of these means over all directions, and no other harmonic.
inline Coefficients even_radiance(const Rgb& mean) { return {mean * std::sqrt(4 * std::numbers::pi_v<float>)}; }

/// Of the same radiance in all directions.
inline VolumeRecord volume_record(const Vec3& position, float radius, const Rgb& mean = Rgb(1),
                                  std::uint32_t media = 1) {
  VolumeRecord record;
  record.position = position;
  record.media = media;
  record.footprint = Footprint::ball(radius);
  record.footprint.order = 1;
  record.jet.value = even_radiance(mean);
  return record;
}

/// Has that mean change along x, y and z by so much.
inline void set_slope(VolumeRecord& record, const Gradient<Rgb>& slope) {
  record.jet.translational = {even_radiance(slope.x), even_radiance(slope.y), even_radiance(slope.z)};
}

}  // namespace isophote::test
