#pragma once

#include <string>
#include <vector>

#include "load/gltf_builder.h"

namespace isophote::testing {

/// A PNG of `channels` (3 or 4) channels of 8 or 16 bits (big-endian in `samples`), its data stored, not compressed.
/// Checksums are left 0: the decoder does not look at them.
inline Bytes png(unsigned width, unsigned height, const Bytes& samples, int channels = 4, int bits = 8) {
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  const auto word = [](Bytes& to, std::size_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<unsigned char>(value >> shift));
  };
  const auto chunk = [&](const char* type, const Bytes& data) {
    word(out, data.size());
    out.insert(out.end(), type, type + 4);
    out.insert(out.end(), data.begin(), data.end());
    word(out, 0);
  };
  Bytes header;
  word(header, width), word(header, height);
  for (const int value : {bits, channels == 4 ? 6 : 2, 0, 0, 0}) header.push_back(static_cast<unsigned char>(value));
  chunk("IHDR", header);

  Bytes rows;
  const std::size_t row = samples.size() / std::max(height, 1u);
  for (std::size_t y = 0; y * row < samples.size(); ++y) {
    rows.push_back(0);  // no filter
    rows.insert(rows.end(), samples.begin() + static_cast<std::ptrdiff_t>(y * row),
                samples.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
  }
  const auto low = static_cast<unsigned char>(rows.size()), high = static_cast<unsigned char>(rows.size() >> 8);
  Bytes stored{0x78, 0x01, 0x01, low, high, static_cast<unsigned char>(~low), static_cast<unsigned char>(~high)};
  stored.insert(stored.end(), rows.begin(), rows.end());
  word(stored, 0);
  chunk("IDAT", stored);
  chunk("IEND", {});
  return out;
}

inline std::string png_uri(const Bytes& bytes) { return "data:image/png;base64," + base64(bytes); }

/// Two by one pixels: (0, 64, 128, 255) and (255, 32, 16, 0).
inline Bytes two_pixels() { return png(2, 1, {0, 64, 128, 255, 255, 32, 16, 0}); }

}  // namespace isophote::testing
