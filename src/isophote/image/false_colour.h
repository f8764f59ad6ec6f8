#pragma once

#include "isophote/image/image.h"

namespace isophote {

/// A perceptually ordered colour (dark violet to yellow) for t in [0, 1], display sRGB decoded to linear.
Rgb false_colour(float t);

/// Signed luminance difference over the mean luminance of the reference: blue where too dark, red where too bright,
/// white at 0, saturated at +-`range`.
RgbImage error_picture(const RgbImage& image, const RgbImage& reference, float range);

}  // namespace isophote
