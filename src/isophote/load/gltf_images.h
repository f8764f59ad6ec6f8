#pragma once

#include <cstdint>
#include <vector>

#include "isophote/load/gltf_file.h"

namespace isophote {

/// The most pixels that an image may have.
inline constexpr std::uint64_t max_image_pixels = 1ull << 27;

struct DecodedImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Decodes a PNG or JPEG, 16-bit PNG cut to 8 bits. Its size is read from its header and checked before, and what
/// decoding takes besides the picture is given back to the budget. Throws UserError `images[I] "NAME": reason`.
DecodedImage decode_image(const GltfFile& file, int image, MemoryBudget& budget);

}  // namespace isophote
