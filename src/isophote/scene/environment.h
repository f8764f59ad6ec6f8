#pragma once

#include <algorithm>
#include <cmath>

#include "isophote/core/ray.h"
#include "isophote/core/rgb.h"
#include "isophote/sampling/distribution.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// An environment map as a light: bilinear radiance, and a partition of its texels into peaks, which are sun-like, and
/// the rest. A texel is a peak where its mean luminance is more than 32 times that of the whole sphere, so that all
/// peaks together take less than 1/32 of it. Points of the map are (u, v) in the unit square, v = 0 towards +Y.
class Environment {
 public:
  static constexpr double peak_ratio = 32;

  /// `map` must outlive this.
  explicit Environment(const EnvironmentMap& map);

  bool empty() const { return map_.radiance.pixels.empty(); }
  Vec2 point(const Vec3& direction) const;
  Vec3 direction(Vec2 point) const;
  Rgb radiance(Vec2 point) const;

  /// Luminance integrated over the solid angle of all peaks, and of the rest. Where it is 0 there is none to sample.
  double peak_power() const { return peak_power_; }
  double rest_power() const { return rest_power_; }

  /// A point of the peaks, in proportion to luminance, with a tenth of the choice uniform over them, and its density in
  /// solid angle. All of the peaks, and nothing else, has a density above 0.
  Vec2 sample_peaks(Vec2 u) const { return peaks_.sample(u); }
  float peak_pdf(Vec2 point) const { return peaks_.empty() ? 0.0f : peaks_.pdf(point) / stretch(point); }
  bool in_peak(Vec2 point) const { return !peaks_.empty() && peaks_.pdf(point) > 0; }
  /// A point of the rest, in proportion to luminance, and its density in solid angle.
  Vec2 sample_rest(Vec2 u) const { return rest_.sample(u); }
  float rest_pdf(Vec2 point) const { return rest_.empty() ? 0.0f : rest_.pdf(point) / stretch(point); }

 private:
  /// Solid angle of an area element of the unit square, over its area.
  static float stretch(Vec2 point) {
    const float least = 0x1p-25f;  // half the grid of random numbers: at the poles themselves it would be 0
    return 2 * pi * pi * std::sin(pi * std::max(least, std::min(point.y, 1 - point.y)));
  }

  const EnvironmentMap& map_;
  double peak_power_ = 0, rest_power_ = 0;
  Distribution2D peaks_, rest_;
};

}  // namespace isophote
