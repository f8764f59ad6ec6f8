#include "isophote/load/gltf_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "isophote/load/gltf_resources.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

using Bytes = std::span<const unsigned char>;

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

std::uint32_t big_endian(Bytes bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + static_cast<std::size_t>(i)];
  return value;
}

std::optional<ImageSize> png_size(Bytes bytes) {
  constexpr std::array<unsigned char, 16> start{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                                0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (bytes.size() < 33 || !std::equal(start.begin(), start.end(), bytes.begin())) return {};
  return ImageSize{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

/// Walks the segments up to the frame header, which has the size.
std::optional<ImageSize> jpeg_size(Bytes bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return {};
  std::size_t at = 2;
  while (at + 9 < bytes.size()) {
    if (bytes[at] != 0xff) return {};
    const unsigned marker = bytes[at + 1];
    if (marker == 0xff) {  // fill
      ++at;
      continue;
    }
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) return ImageSize{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return {};
}

void check_size(Bytes bytes, MemoryBudget& budget) {
  auto size = png_size(bytes);
  if (!size) size = jpeg_size(bytes);
  if (!size) throw UserError("is neither a PNG nor a JPEG");
  const std::uint64_t pixels = std::uint64_t{size->width} * size->height;
  if (pixels == 0) throw UserError("has no pixels");
  if (pixels > max_image_pixels)
    throw UserError(
        fmt::format("is {}x{}, more than the {} pixels allowed", size->width, size->height, max_image_pixels));
  budget.take(8 * pixels, "image");
}

DecodedImage decode(Bytes bytes, MemoryBudget& budget) {
  check_size(bytes, budget);
  if (bytes.size() > 0x7fffffff) throw UserError("is over 2 GiB");
  tinygltf::Image decoded;
  std::string error, warning;
  if (!tinygltf::LoadImageData(&decoded, 0, &error, &warning, 0, 0, bytes.data(), static_cast<int>(bytes.size()),
                               nullptr))
    throw UserError("is broken: it cannot be decoded");
  DecodedImage image{decoded.width, decoded.height, std::move(decoded.image)};
  if (decoded.bits == 16) {
    const std::size_t values = image.rgba.size() / 2;
    for (std::size_t i = 0; i < values; ++i) {
      const unsigned value = image.rgba[2 * i] | static_cast<unsigned>(image.rgba[2 * i + 1]) << 8;
      image.rgba[i] = static_cast<std::uint8_t>((value * 255 + 32767) / 65535);
    }
    image.rgba.resize(values);
  }
  return image;
}

}  // namespace

DecodedImage decode_image(const GltfFile& file, int index, MemoryBudget& budget) {
  const ImageSource& source = file.images[static_cast<std::size_t>(index)];
  return with_place(place_name("images", static_cast<std::size_t>(index), source.name), [&] {
    if (source.buffer_view >= 0) {
      const tinygltf::BufferView& view = file.model.bufferViews[static_cast<std::size_t>(source.buffer_view)];
      const Bytes buffer = file.model.buffers[static_cast<std::size_t>(view.buffer)].data;
      return decode(buffer.subspan(view.byteOffset, view.byteLength), budget);
    }
    if (source.uri.empty()) throw UserError("has neither a uri nor a buffer view");
    const auto bytes = read_resource(source.uri, file.folder, budget);
    return with_place(source.uri.starts_with("data:") ? "data URI" : "'" + source.uri + "'",
                      [&] { return decode(bytes, budget); });
  });
}

}  // namespace isophote
