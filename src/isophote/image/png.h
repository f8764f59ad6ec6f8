#pragma once

#include <cstdint>
#include <string>

#include "isophote/image/image.h"

namespace isophote {

/// Writes 8-bit sRGB: each linear value times 2^exposure, clipped to [0, 1]. Temporary name and rename, as write_exr.
void write_png(const std::string& path, const RgbImage& image, float exposure);

/// An exposure in stops that brings the picture's bright parts just under white (the 95th percentile of luminance to
/// 0.8, black pixels left out); 0 for an all-black picture.
float auto_exposure(const RgbImage& image);

}  // namespace isophote
