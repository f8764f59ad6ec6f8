#pragma once

#include <string>
#include <vector>

#include "load/gltf_builder.h"

namespace isophote::testing {

/// A PNG of `channels` (3 or 4) channels of 8 or 16 bits around packed data. Checksums are left 0: the decoder does not
/// look at them.
inline Bytes png_of(unsigned width, unsigned height, const Bytes& packed, int channels = 4, int bits = 8) {
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
  chunk("IDAT", packed);
  chunk("IEND", {});
  return out;
}

/// A PNG of these samples (16-bit ones big-endian), its data stored, not compressed; under 64 KiB of it.
inline Bytes png(unsigned width, unsigned height, const Bytes& samples, int channels = 4, int bits = 8) {
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
  stored.resize(stored.size() + 4);
  return png_of(width, height, stored, channels, bits);
}

/// At least `count` zeros as deflate packs them with its fixed codes: a zero, and repetitions of 258 more.
inline Bytes packed_zeros(std::size_t count) {
  Bytes out{0x78, 0x01};
  unsigned bits = 0;
  int used = 0;
  const auto put = [&](const char* code) {
    for (; *code; ++code) {
      bits |= static_cast<unsigned>(*code == '1') << used;
      if (++used == 8) out.push_back(static_cast<unsigned char>(bits)), bits = 0, used = 0;
    }
  };
  put("110"), put("00110000");                                                          // the last block; 0
  for (std::size_t done = 1; done < count; done += 258) put("11000101"), put("00000");  // 258 times, 1 back
  put("0000000"), put("0000000"), out.insert(out.end(), 4, 0);                          // end; to a whole byte
  return out;
}

inline std::string png_uri(const Bytes& bytes) { return "data:image/png;base64," + base64(bytes); }

/// Two by one pixels: (0, 64, 128, 255) and (255, 32, 16, 0).
inline Bytes two_pixels() { return png(2, 1, {0, 64, 128, 255, 255, 32, 16, 0}); }

}  // namespace isophote::testing
