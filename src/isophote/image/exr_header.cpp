#include "isophote/image/exr_header.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace isophote {
namespace {

constexpr std::uint64_t max_pixels = 1ull << 28;
constexpr int tiled_flag = 0x200, deep_flag = 0x800, multi_part_flag = 0x1000;

[[noreturn]] void refuse(const std::string& reason) { throw std::runtime_error(reason); }

/// Reads little-endian words and names, never past the end.
struct Reader {
  std::istream& file;
  std::uint64_t size;

  std::uint64_t left() const { return size - static_cast<std::uint64_t>(file.tellg()); }
  std::uint32_t word() {
    unsigned char b[4];
    if (!file.read(reinterpret_cast<char*>(b), 4)) refuse("the header is cut off");
    return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
  }
  std::string name() {
    std::string text;
    for (char c; file.get(c) && c != 0; text += c)
      if (text.size() == 255) refuse("a name in the header is too long");
    if (!file) refuse("the header is cut off");
    return text;
  }
  std::uint64_t offset() {
    const std::uint64_t low = word();
    return low | static_cast<std::uint64_t>(word()) << 32;
  }
  void skip(std::uint64_t bytes) { file.seekg(static_cast<std::streamoff>(bytes), std::ios::cur); }
};

/// Checks the lengths that an attribute's value holds within itself.
void check_value(Reader& in, const std::string& name, const std::string& type, std::uint64_t bytes) {
  if (type == "preview" && bytes >= 8) {
    const std::uint64_t width = in.word(), height = in.word();
    if (width > max_pixels || height > max_pixels || width * height * 4 != bytes - 8)
      refuse("the preview picture has a wrong size");
    bytes -= 8;
  } else if (type == "stringvector") {
    while (bytes >= 4) {
      const std::uint64_t length = in.word();
      bytes -= 4;
      if (length > bytes) refuse("a text in '" + name + "' is longer than '" + name + "'");
      in.skip(length);
      bytes -= length;
    }
  }
  in.skip(bytes);
}

/// Checks every attribute's length and returns the version word; `file` is left after it, where the attributes start.
int check_attributes(std::istream& file, std::uint64_t size) {
  Reader in{file, size};
  if (size < 8 || in.word() != 20000630) refuse("not an OpenEXR file");
  const int version = static_cast<int>(in.word());
  if ((version & 0xff) != 2) refuse("OpenEXR version " + std::to_string(version & 0xff) + " is not supported");
  if (version & (deep_flag | multi_part_flag)) refuse("deep and multi-part files are not supported");
  for (std::string name = in.name(); !name.empty(); name = in.name()) {
    const std::string type = in.name();
    const std::uint64_t bytes = in.word();
    if (bytes > in.left()) refuse("attribute '" + name + "' is longer than the file");
    check_value(in, name, type, bytes);
  }
  file.seekg(8);
  return version;
}

std::uint64_t lines_per_chunk(Imf::Compression compression) {
  switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 1;
  }
}

/// The most values a byte can stand for: deflate packs 1032 bytes into one; before it, the DWA kinds may already have
/// packed a block of 64 values.
std::uint64_t most_values_per_byte(Imf::Compression compression) {
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return dwa ? 1032 * 64 : 1032;
}

Imf::Header read_header(std::istream& file, int version) {
  struct Stream : Imf::IStream {
    std::istream& in;
    explicit Stream(std::istream& in_) : IStream("header"), in(in_) {}
    bool read(char c[], int n) override {
      if (!in.read(c, n)) refuse("the header is cut off");
      return true;
    }
    std::uint64_t tellg() override { return static_cast<std::uint64_t>(in.tellg()); }
    void seekg(std::uint64_t pos) override { in.seekg(static_cast<std::streamoff>(pos)); }
  } stream(file);
  Imf::Header header;
  header.readFrom(stream, version);
  header.sanityCheck(version & tiled_flag);
  return header;
}

/// A table that was never filled in (the writer did not finish) or that points elsewhere.
void check_offsets(Reader in, std::uint64_t chunks) {
  for (std::uint64_t i = 0; i < chunks; ++i)
    if (const std::uint64_t at = in.offset(); at == 0 || at >= in.size)
      refuse("the file is not complete: some of its pixels are not in it");
}

}  // namespace

ExrClaim check_exr_header(std::istream& file, std::uint64_t size) {
  const int version = check_attributes(file, size);
  const bool tiled = version & tiled_flag;
  const Imf::Header header = read_header(file, version);

  const Imath::Box2i& window = header.dataWindow();
  const auto width = static_cast<std::uint64_t>(static_cast<std::int64_t>(window.max.x) - window.min.x + 1);
  const auto height = static_cast<std::uint64_t>(static_cast<std::int64_t>(window.max.y) - window.min.y + 1);
  const std::string claim = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (width > max_pixels || height > max_pixels || width * height > max_pixels) refuse(claim + " are too many");

  std::uint64_t chunks = 0, chunk = 0, row = 0;  // values of a channel in a chunk, and in a row of chunks
  if (tiled) {
    const Imf::TileDescription& tile = header.tileDescription();
    if (tile.xSize > max_pixels || tile.ySize > max_pixels || std::uint64_t{tile.xSize} * tile.ySize > max_pixels)
      refuse("the tiles are too large");
    chunks = ((width + tile.xSize - 1) / tile.xSize) * ((height + tile.ySize - 1) / tile.ySize);
    chunk = std::uint64_t{tile.xSize} * tile.ySize;
    row = width * tile.ySize;
  } else {
    const std::uint64_t lines = lines_per_chunk(header.compression());
    chunks = (height + lines - 1) / lines;
    chunk = width * lines;
  }
  std::uint64_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
  const std::uint64_t values = std::max(width * height, chunk);
  if (chunks * 8 > size || values * channels / most_values_per_byte(header.compression()) > size)
    refuse("the header claims " + claim + " in " + std::to_string(channels) + " channels, more than the file can hold");
  check_offsets(Reader{file, size}, chunks);
  // A chunk packed, unpacked and in between; a row of tiles is kept.
  return {width * height, (3 * chunk + row) * channels * sizeof(float)};
}

}  // namespace isophote
