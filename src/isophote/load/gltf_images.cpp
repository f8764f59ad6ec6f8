#include "isophote/load/gltf_images.h"

#include <fmt/format.h>

#include <optional>

#include "isophote/image/png_decode.h"
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

void check_size(std::uint64_t width, std::uint64_t height) {
  if (width * height == 0) throw UserError("has no pixels");
  if (width * height > max_image_pixels)
    throw UserError(fmt::format("is {}x{}, more than the {} pixels allowed", width, height, max_image_pixels));
}

/// Calls `body` with `scratch` bytes taken beside the result's own.
template <class Body>
DecodedImage within(MemoryBudget& budget, std::uint64_t pixels, std::uint64_t scratch, const Body& body) {
  budget.take(4 * pixels + scratch, "image");
  DecodedImage image = body();
  budget.give_back(scratch);
  return image;
}

DecodedImage decode_jpeg(Bytes bytes) {
  if (bytes.size() > 0x7fffffff) throw UserError("is over 2 GiB");
  tinygltf::Image decoded;
  std::string error, warning;
  if (!tinygltf::LoadImageData(&decoded, 0, &error, &warning, 0, 0, bytes.data(), static_cast<int>(bytes.size()),
                               nullptr))
    throw UserError("is broken: it cannot be decoded");
  return {decoded.width, decoded.height, std::move(decoded.image)};
}

DecodedImage decode(Bytes bytes, MemoryBudget& budget) {
  if (const auto png = read_png_header(bytes)) {
    check_size(png->width, png->height);
    return within(budget, png->pixels(), png->scratch(), [&] {
      return DecodedImage{static_cast<int>(png->width), static_cast<int>(png->height), decode_png(bytes)};
    });
  }
  const auto jpeg = jpeg_size(bytes);
  if (!jpeg) throw UserError("is neither a PNG nor a JPEG");
  check_size(jpeg->width, jpeg->height);
  const std::uint64_t pixels = std::uint64_t{jpeg->width} * jpeg->height;
  // A progressive one of four channels: 2 bytes a coefficient and 1 a sample, and the result.
  return within(budget, pixels, 12 * pixels, [&] { return decode_jpeg(bytes); });
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
