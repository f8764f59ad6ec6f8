#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isophote {

/// What a PNG claims to be.
struct PngHeader {
  std::uint32_t width = 0, height = 0;
  int depth = 8;     ///< bits a channel
  int channels = 4;  ///< as encoded: 1 for grey or an index into a palette, 2 for grey with alpha, 3, 4

  std::uint64_t pixels() const { return std::uint64_t{width} * height; }
  /// Bytes that `decode_png` takes beside its result, which has 4 a pixel: the rows that filters need, and what
  /// inflates.
  std::uint64_t scratch() const { return 2 * (depth == 16 ? 8u : 4u) * (std::uint64_t{width} + 8) + (1u << 17); }
};

/// The header of a PNG; nothing where `bytes` do not begin as one does.
std::optional<PngHeader> read_png_header(std::span<const unsigned char> bytes);

/// The picture as 8-bit RGBA, row by row from the top left: values as encoded (no profile and no gamma is applied), 16
/// bits rounded to 8. Checksums are not looked at. No more is inflated than the picture has room for, whatever the file
/// packs. The caller has checked that what the header claims is wanted. Throws UserError with the bare reason.
std::vector<std::uint8_t> decode_png(std::span<const unsigned char> bytes);

}  // namespace isophote
