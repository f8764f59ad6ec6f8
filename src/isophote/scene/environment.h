#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

  struct Peak {
    std::uint32_t texel;
    double power;  ///< luminance integrated over the texel's solid angle
  };
  const std::vector<Peak>& peaks() const { return peaks_; }
  double rest_power() const { return rest_power_; }

  /// The peak that the point lies in.
  std::optional<std::uint32_t> peak_at(Vec2 point) const;
  /// A point of a peak's texel, and the density there in solid angle.
  Vec2 sample_peak(std::uint32_t peak, Vec2 u) const;
  float peak_pdf(Vec2 point) const;
  /// A point of the rest, in proportion to its luminance, and the density in solid angle.
  Vec2 sample_rest(Vec2 u) const { return rest_.sample(u); }
  float rest_pdf(Vec2 point) const;

 private:
  const EnvironmentMap& map_;
  std::vector<Peak> peaks_;  // by texel
  double rest_power_ = 0;
  Distribution2D rest_;
};

}  // namespace isophote
