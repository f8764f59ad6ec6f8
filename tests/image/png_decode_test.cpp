#include "isophote/image/png_decode.h"

#include <gtest/gtest.h>
#include <png.h>

#include <string>

#include "isophote/core/error.h"

namespace isophote {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Source {
  unsigned width = 0, height = 0;
  int depth = 8, type = PNG_COLOR_TYPE_RGB_ALPHA;
  bool interlaced = false, transparent = false;  // transparent: with a tRNS chunk
};

/// Row y of arbitrary packed samples.
Bytes source_row(const Source& s, unsigned y) {
  constexpr int channels[] = {1, 0, 3, 1, 2, 0, 4};
  Bytes row((s.width * static_cast<unsigned>(channels[s.type] * s.depth) + 7) / 8);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<std::uint8_t>(i * 37 + y * 101 + i * y);
  if (s.type == PNG_COLOR_TYPE_PALETTE && s.depth == 8)
    for (std::uint8_t& index : row) index %= 16;
  return row;
}

Bytes encode(const Source& s) {
  Bytes out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto write = [](png_structp p, png_bytep data, std::size_t size) {
    auto& to = *static_cast<Bytes*>(png_get_io_ptr(p));
    to.insert(to.end(), data, data + size);
  };
  png_set_write_fn(png, &out, write, nullptr);
  png_set_IHDR(png, info, s.width, s.height, s.depth, s.type, s.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (s.type == PNG_COLOR_TYPE_PALETTE) {
    png_color palette[16];
    for (int i = 0; i < 16; ++i)
      palette[i] = {static_cast<png_byte>(i * 16), static_cast<png_byte>(255 - i), static_cast<png_byte>(i * i)};
    png_set_PLTE(png, info, palette, std::min(16, 1 << s.depth));
  }
  if (s.transparent) {
    png_byte alphas[] = {7, 200};
    png_color_16 key{};
    key.gray = key.red = key.green = key.blue = 0;
    png_set_tRNS(png, info, alphas, 2, s.type == PNG_COLOR_TYPE_PALETTE ? nullptr : &key);
  }
  png_set_gAMA(png, info, 1.0);  // to be left alone
  png_write_info(png, info);
  const int passes = png_set_interlace_handling(png);
  for (int pass = 0; pass < passes; ++pass)
    for (unsigned y = 0; y < s.height; ++y) png_write_row(png, source_row(s, y).data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

/// What the format says the pixels are.
Bytes expected(const Source& s) {
  Bytes rgba;
  const auto sample = [&](const Bytes& row, unsigned i) -> unsigned {
    if (s.depth == 16) return row[2 * i] << 8 | row[2 * i + 1];
    const unsigned per_byte = 8 / static_cast<unsigned>(s.depth), shift = 8 - s.depth * (i % per_byte + 1);
    return row[i / per_byte] >> shift & ((1u << s.depth) - 1);
  };
  const unsigned most = (1u << s.depth) - 1;
  const auto rounded = [&](unsigned v) { return static_cast<std::uint8_t>((v * 255 + most / 2) / most); };
  for (unsigned y = 0; y < s.height; ++y) {
    const Bytes row = source_row(s, y);
    for (unsigned x = 0; x < s.width; ++x) {
      if (s.type == PNG_COLOR_TYPE_PALETTE) {
        const unsigned i = sample(row, x);
        const std::uint8_t alpha = !s.transparent ? 255 : i == 0 ? 7 : i == 1 ? 200 : 255;
        for (const unsigned v : {i * 16, 255 - i, i * i, unsigned{alpha}}) rgba.push_back(static_cast<std::uint8_t>(v));
        continue;
      }
      const bool grey = !(s.type & PNG_COLOR_MASK_COLOR), has_alpha = s.type & PNG_COLOR_MASK_ALPHA;
      const unsigned colours = grey ? 1 : 3, channels = colours + (has_alpha ? 1 : 0);
      bool is_key = true;
      for (unsigned c = 0; c < 3; ++c) {
        const unsigned v = sample(row, x * channels + (grey ? 0 : c));
        is_key = is_key && v == 0;
        rgba.push_back(rounded(v));
      }
      const bool clear = s.transparent && is_key;
      rgba.push_back(has_alpha ? rounded(sample(row, x * channels + colours)) : clear ? 0 : 255);
    }
  }
  return rgba;
}

std::string refusal(const Bytes& bytes) {
  try {
    decode_png(bytes);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(PngDecode, EveryKindBecomesRgba) {
  struct Kind {
    int type;
    std::vector<int> depths;
  };
  const Kind kinds[] = {{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                        {PNG_COLOR_TYPE_RGB, {8, 16}},
                        {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                        {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                        {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const Kind& kind : kinds)
    for (const int depth : kind.depths)
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true}) {
          if (transparent && kind.type & PNG_COLOR_MASK_ALPHA) continue;
          for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {9u, 1u}, {1u, 9u}, {21u, 19u}}) {
            const Source source{width, height, depth, kind.type, interlaced, transparent};
            EXPECT_EQ(decode_png(encode(source)), expected(source))
                << "type " << kind.type << " depth " << depth << (interlaced ? " interlaced " : " ") << transparent
                << " " << width << "x" << height;
          }
        }
}

TEST(PngDecode, HeaderSaysWhatIsNeeded) {
  const auto header = read_png_header(encode({300, 20, 16, PNG_COLOR_TYPE_GRAY_ALPHA}));
  ASSERT_TRUE(header);
  EXPECT_EQ(header->width, 300u);
  EXPECT_EQ(header->height, 20u);
  EXPECT_EQ(header->depth, 16);
  EXPECT_EQ(header->channels, 2);
  EXPECT_FALSE(read_png_header(Bytes(100)));
  EXPECT_FALSE(read_png_header(Bytes{0x89, 'P', 'N', 'G'}));
}

TEST(PngDecode, RefusesEveryTruncationOfThePixels) {
  const Bytes whole = encode({5, 4});
  const auto end = whole.end() - 12 - 4 - 4;  // the end chunk and two checksums are not looked at
  for (auto to = whole.begin(); to < end; ++to) EXPECT_NE(refusal(Bytes(whole.begin(), to)), "") << to - whole.begin();
}

TEST(PngDecode, SurvivesEveryBrokenByte) {
  for (const bool interlaced : {false, true}) {
    const Bytes whole = encode({5, 4, 4, PNG_COLOR_TYPE_PALETTE, interlaced, true});
    for (std::size_t i = 24; i < whole.size(); ++i)  // with the size as it is
      for (const int flip : {0x01, 0x10, 0xff}) {
        Bytes broken = whole;
        broken[i] ^= static_cast<std::uint8_t>(flip);
        refusal(broken);
      }
  }
}

TEST(PngDecode, RefusesWhatTheFileCannotHold) {
  Bytes claims = encode({5, 4});
  claims[17] = claims[21] = 1;  // 65541x65540
  EXPECT_EQ(refusal(claims), "is broken: its header claims more than the file can hold");
}

}  // namespace
}  // namespace isophote
