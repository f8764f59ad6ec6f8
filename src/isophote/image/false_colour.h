#pragma once

#include <vector>

#include "isophote/image/image.h"

namespace isophote {

/// A perceptually ordered colour (dark violet to yellow) for t in [0, 1], display sRGB decoded to linear.
Rgb false_colour(float t);

/// How values become colours: `low` and less is violet, `high` and more is yellow.
struct ColourScale {
  float low = 0, high = 1;
  bool logarithmic = false;

  Rgb operator()(float value) const;
};

/// A scale for values of which 2% may lie beyond its upper end: linear from 0, or logarithmic from where another 2% lie
/// below. Values that are not above 0 are left out.
ColourScale colour_scale(std::vector<float> values, bool logarithmic);

/// Signed luminance difference over the mean luminance of the reference: blue where too dark, red where too bright,
/// white at 0, saturated at +-`range`.
RgbImage error_picture(const RgbImage& image, const RgbImage& reference, float range);

}  // namespace isophote
