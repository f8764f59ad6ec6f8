#pragma once

#include <algorithm>
#include <cmath>

namespace isophote {

/// The transfer functions of sRGB (IEC 61966-2-1) on [0, 1]; values outside are clipped, NaN encodes as 0.
inline float srgb_encode(float linear) {
  if (!(linear > 0)) return 0;
  if (linear <= 0.0031308f) return 12.92f * linear;
  return std::min(1.055f * std::pow(linear, 1 / 2.4f) - 0.055f, 1.0f);
}
inline float srgb_decode(float encoded) {
  const float e = std::clamp(encoded, 0.0f, 1.0f);
  return e <= 0.04045f ? e / 12.92f : std::pow((e + 0.055f) / 1.055f, 2.4f);
}

}  // namespace isophote
