#include "isophote/image/png_decode.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <new>

#include "isophote/core/error.h"

namespace isophote {
namespace {

using Bytes = std::span<const unsigned char>;

std::uint32_t big_endian(Bytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}

constexpr int passes = 7;  // of an interlaced picture

/// Where the library's callbacks put the rows. Interlaced ones come pass by pass, each a smaller picture whose pixels
/// are spread over the whole.
struct Canvas {
  PngHeader header;
  std::vector<std::uint8_t> rgba;
  bool interlaced = false;
  std::uint64_t rows_left = 1;

  void start(bool is_interlaced) {
    interlaced = is_interlaced;
    rows_left = interlaced ? 0 : header.height;
    for (int pass = 0; interlaced && pass < passes; ++pass)
      if (PNG_PASS_COLS(header.width, pass) > 0) rows_left += PNG_PASS_ROWS(header.height, pass);
  }
  void put(const unsigned char* row, std::uint32_t y, int pass) {
    if (rows_left == 0) return;
    --rows_left;
    const std::size_t width = header.width;
    if (!interlaced) {
      std::memcpy(rgba.data() + y * width * 4, row, width * 4);
      return;
    }
    const std::uint32_t columns = PNG_PASS_COLS(header.width, pass);
    std::uint8_t* line = rgba.data() + PNG_ROW_FROM_PASS_ROW(y, pass) * width * 4;
    for (std::uint32_t x = 0; x < columns; ++x)
      std::memcpy(line + std::size_t{4} * PNG_COL_FROM_PASS_COL(x, pass), row + std::size_t{4} * x, 4);
  }
};

Canvas& canvas(png_structp png) { return *static_cast<Canvas*>(png_get_progressive_ptr(png)); }

/// Owns what libpng allocates.
struct Reader {
  png_structp png;
  png_infop info;

  Reader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, ignore)), info(nullptr) {
    if (png) info = png_create_info_struct(png);
    if (!info) png_destroy_read_struct(&png, nullptr, nullptr), throw std::bad_alloc();
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[noreturn]] static void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }
  static void ignore(png_structp, png_const_charp) {}
};

/// All kinds of PNG become 8-bit RGBA.
void on_header(png_structp png, png_infop info) {
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_read_update_info(png, info);
  if (png_get_channels(png, info) != 4 || png_get_bit_depth(png, info) != 8) png_error(png, "not RGBA");
  canvas(png).start(png_get_interlace_type(png, info) != PNG_INTERLACE_NONE);
}

void on_row(png_structp png, png_bytep row, png_uint_32 y, int pass) { canvas(png).put(row, y, pass); }

/// The library skips an error's frames without unwinding them: nothing here has a destructor.
bool run(Reader& reader, Bytes bytes, Canvas& target) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
  png_set_option(png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
  // Texts, profiles and the like, which may be packed too, are skipped.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_progressive_read_fn(png, &target, on_header, on_row, nullptr);
  // Of the two ways to read, this one does not inflate on to the end of the data after the last row.
  png_process_data(png, reader.info, const_cast<png_bytep>(bytes.data()), bytes.size());
  return true;
}

}  // namespace

std::optional<PngHeader> read_png_header(Bytes bytes) {
  constexpr std::array<unsigned char, 16> start{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                                0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (bytes.size() < 33 || !std::equal(start.begin(), start.end(), bytes.begin())) return {};
  constexpr int channels_of_type[] = {1, 1, 3, 1, 2, 1, 4};  // those that are no type are refused by decoding
  return PngHeader{big_endian(bytes, 16), big_endian(bytes, 20), bytes[24],
                   channels_of_type[std::min<int>(bytes[25], 6)]};
}

std::vector<std::uint8_t> decode_png(Bytes bytes) {
  const auto header = read_png_header(bytes);
  if (!header) throw UserError("is not a PNG");
  constexpr std::uint64_t most_packed = 1032;  // bytes that deflate packs into one
  const std::uint64_t least = header->pixels() * static_cast<unsigned>(header->depth * header->channels) / 8;
  if (least / most_packed > bytes.size()) throw UserError("is broken: its header claims more than the file can hold");
  Reader reader;
  Canvas target{*header, std::vector<std::uint8_t>(header->pixels() * 4)};
  if (!run(reader, bytes, target) || target.rows_left > 0) throw UserError("is broken: it cannot be decoded");
  return std::move(target.rgba);
}

}  // namespace isophote
