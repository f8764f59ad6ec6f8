#include "isophote/image/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "isophote/core/atomic_file.h"
#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/image/srgb.h"

namespace isophote {
namespace {

std::uint8_t encode_byte(float linear) { return static_cast<std::uint8_t>(srgb_encode(linear) * 255 + 0.5f); }

}  // namespace

void write_png(const std::string& path, const RgbImage& image, float exposure) {
  ISOPHOTE_CHECK(image.pixels.size(), >, 0u);
  const float scale = std::exp2(exposure);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& c : image.pixels)
    for (int i = 0; i < 3; ++i) bytes.push_back(encode_byte(c[i] * scale));

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<char> encoded(size);
  if (!png_image_write_to_memory(&png, encoded.data(), &size, 0, bytes.data(), 0, nullptr))
    throw UserError(path + ": cannot write PNG: " + png.message);

  AtomicFile file(path);
  file.stream().write(encoded.data(), static_cast<std::streamsize>(size));
  file.commit();
}

float auto_exposure(const RgbImage& image) {
  std::vector<float> lit;
  for (const Rgb& c : image.pixels)
    if (const float l = luminance(c); l > 0 && std::isfinite(l)) lit.push_back(l);
  if (lit.empty()) return 0;
  const auto rank = lit.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), rank, lit.end());
  return std::log2(0.8f / *rank);
}

}  // namespace isophote
