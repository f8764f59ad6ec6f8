#include "isophote/image/exr.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "isophote/core/error.h"
#include "test_files.h"

namespace isophote {
namespace {

using testing_files::bytes_of;
using testing_files::le;
using testing_files::put;
using testing_files::temporary;

std::vector<float> ramp(int count, float scale) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) values.push_back(static_cast<float>(i) * scale);
  return values;
}

std::string failure_of(const std::string& path) {
  try {
    read_exr(path);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

// Parts of an uncompressed OpenEXR file, put together by hand from the format's description.
std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + le<std::int32_t>(static_cast<std::int32_t>(value.size())) + value;
}
std::string channel(const std::string& name, int type) {
  return name + '\0' + le<std::int32_t>(type) + std::string(4, '\0') + le<std::int32_t>(1) + le<std::int32_t>(1);
}
std::string box(int x0, int y0, int x1, int y1) {
  return le<std::int32_t>(x0) + le<std::int32_t>(y0) + le<std::int32_t>(x1) + le<std::int32_t>(y1);
}
constexpr int half_type = 1, float_type = 2;
struct HeaderParts {
  std::uint32_t version = 2;
  std::string channels, data_window, more{};
  char compression = 0;
};
std::string header(const HeaderParts& parts) {
  return le<std::uint32_t>(20000630) + le<std::uint32_t>(parts.version) +
         attribute("channels", "chlist", parts.channels + '\0') +
         attribute("compression", "compression", std::string(1, parts.compression)) +
         attribute("dataWindow", "box2i", parts.data_window) + attribute("displayWindow", "box2i", box(0, 0, 9, 9)) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) + attribute("pixelAspectRatio", "float", le(1.0f)) +
         attribute("screenWindowCenter", "v2f", le(0.0f) + le(0.0f)) +
         attribute("screenWindowWidth", "float", le(1.0f)) + parts.more + '\0';
}

TEST(Exr, RoundTripKeepsEveryBit) {
  const float values[] = {0.0f,
                          -0.0f,
                          1.0f,
                          -2.5f,
                          65536.0f,
                          1e-42f,
                          3.4e38f,
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::quiet_NaN(),
                          0.1f,
                          1 / 3.0f};
  ExrFile file;
  file.width = 4;
  file.height = 3;
  file.add("depth.Z", {std::begin(values), std::end(values)});
  file.add("A", ramp(12, 0.5f));
  const std::string path = temporary("a.exr");
  write_exr(path, file);

  const ExrFile back = read_exr(path);
  ASSERT_EQ(back.width, 4);
  ASSERT_EQ(back.height, 3);
  ASSERT_EQ(back.channels.size(), 2u);
  const auto bits = [](const std::vector<float>& v) {
    std::vector<std::uint32_t> b;
    for (float x : v) b.push_back(std::bit_cast<std::uint32_t>(x));
    return b;
  };
  EXPECT_EQ(bits(back.find("depth.Z")->values), bits({std::begin(values), std::end(values)}));
  EXPECT_EQ(back.find("A")->values, ramp(12, 0.5f));
  EXPECT_EQ(back.find("Z"), nullptr);
}

TEST(Exr, LayersAreTriplesOfChannels) {
  RgbImage beauty(2, 1), normal(2, 1);
  beauty.pixels = {{1, 2, 3}, {4, 5, 6}};
  normal.pixels = {{0, 0, 1}, {0, -1, 0}};
  ExrFile file;
  file.width = 2;
  file.height = 1;
  file.add_rgb("", beauty);
  file.add_rgb("normal", normal, "XYZ");
  file.add_rgb("irradiance", beauty);
  file.add("depth.Z", {7, 8});
  file.add("half.R", {7, 8});
  write_exr(temporary("a.exr"), file);

  const ExrFile back = read_exr(temporary("a.exr"));
  EXPECT_EQ(back.layers(), (std::vector<std::string>{"", "irradiance", "normal"}));
  EXPECT_EQ(back.rgb("").pixels, beauty.pixels);
  EXPECT_EQ(back.rgb("normal").pixels, normal.pixels);
  EXPECT_EQ(back.find("irradiance.G")->values, (std::vector<float>{2, 5}));
  try {
    back.rgb("indirect");
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "no layer 'indirect'; there is: R,G,B, irradiance, normal");
  }
}

TEST(Exr, SameContentsGiveSameBytes) {
  ExrFile file, reordered;
  for (ExrFile* f : {&file, &reordered}) f->width = 40, f->height = 37;
  file.add("B", ramp(40 * 37, 0.25f));
  file.add("A", ramp(40 * 37, 3));
  reordered.add("A", ramp(40 * 37, 3));
  reordered.add("B", ramp(40 * 37, 0.25f));
  write_exr(temporary("a.exr"), file);
  write_exr(temporary("b.exr"), reordered);
  EXPECT_EQ(bytes_of(temporary("a.exr")), bytes_of(temporary("b.exr")));
  EXPECT_LT(bytes_of(temporary("a.exr")).size(), 40u * 37 * 8);  // it is compressed
}

TEST(Exr, ReadsHalfFloatsAndWindowsAwayFromTheOrigin) {
  const std::string head =
      header({.channels = channel("G", half_type) + channel("R", float_type), .data_window = box(-5, 10, -4, 11)});
  const std::uint64_t first = head.size() + 16, chunk = 8 + 2 * 2 + 2 * 4;
  const auto line = [](int y, std::uint16_t a, std::uint16_t b, float c, float d) {
    return le<std::int32_t>(y) + le<std::int32_t>(12) + le(a) + le(b) + le(c) + le(d);
  };
  put(temporary("a.exr"),
      head + le(first) + le(first + chunk) + line(10, 0x3c00, 0xc000, 5, 6) + line(11, 0x3800, 0x7bff, 7, 8));
  const ExrFile file = read_exr(temporary("a.exr"));
  EXPECT_EQ(file.width, 2);
  EXPECT_EQ(file.height, 2);
  EXPECT_EQ(file.find("G")->values, (std::vector<float>{1, -2, 0.5f, 65504}));
  EXPECT_EQ(file.find("R")->values, (std::vector<float>{5, 6, 7, 8}));
}

TEST(Exr, ReadsTiles) {
  constexpr std::uint32_t tiled = 0x200;
  const std::string tiles = le<std::uint32_t>(2) + le<std::uint32_t>(2) + std::string(1, '\0');
  const std::string head = header({.version = 2 | tiled,
                                   .channels = channel("Z", float_type),
                                   .data_window = box(0, 0, 2, 0),
                                   .more = attribute("tiles", "tiledesc", tiles)});
  const std::uint64_t first = head.size() + 16, chunk = 20 + 8;
  const auto tile = [](int x, const std::string& values) {
    return le<std::int32_t>(x) + le<std::int32_t>(0) + le<std::int32_t>(0) + le<std::int32_t>(0) +
           le<std::int32_t>(static_cast<std::int32_t>(values.size())) + values;
  };
  put(temporary("a.exr"), head + le(first) + le(first + chunk) + tile(0, le(1.0f) + le(2.0f)) + tile(1, le(3.0f)));
  EXPECT_EQ(read_exr(temporary("a.exr")).find("Z")->values, (std::vector<float>{1, 2, 3}));
}

TEST(Exr, RefusesEveryTruncation) {
  ExrFile file;
  file.width = 3;
  file.height = 20;  // two chunks of ZIP
  file.add("R", ramp(60, 0.1f));
  write_exr(temporary("a.exr"), file);
  const std::string whole = bytes_of(temporary("a.exr"));
  for (std::size_t n = 0; n < whole.size(); ++n) {
    put(temporary("cut.exr"), whole.substr(0, n));
    EXPECT_EQ(failure_of(temporary("cut.exr")).find(temporary("cut.exr") + ": cannot read EXR: "), 0u) << n;
  }
}

TEST(Exr, SurvivesEveryBrokenByte) {
  ExrFile file;
  file.width = 3;
  file.height = 20;
  file.add("R", ramp(60, 0.1f));
  write_exr(temporary("a.exr"), file);
  const std::string whole = bytes_of(temporary("a.exr"));
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string broken = whole;
      broken[i] = static_cast<char>(broken[i] ^ flip);
      put(temporary("broken.exr"), broken);
      try {
        const ExrFile read = read_exr(temporary("broken.exr"));
        EXPECT_LE(static_cast<long long>(read.width) * read.height, 1032LL * 2 * static_cast<long long>(whole.size()));
      } catch (const UserError&) {
      }
    }
}

TEST(Exr, RefusesAbsurdClaimsBeforeAllocating) {
  const std::string r = channel("R", float_type);
  const auto refusal = [](const std::string& bytes) {
    put(temporary("a.exr"), bytes + std::string(64, '\0'));
    const std::string text = failure_of(temporary("a.exr"));
    return text.substr(std::min(text.size(), (temporary("a.exr") + ": cannot read EXR: ").size()));
  };
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, 1 << 29, 1 << 29)})),
            "536870913x536870913 pixels are too many");
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, (1 << 14) - 1, (1 << 14) - 1)})),
            "the header claims 16384x16384 pixels in 1 channels, more than the file can hold");
  constexpr char zip = 3;
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, (1 << 28) - 1, 0), .compression = zip})),
            "the header claims 268435456x1 pixels in 1 channels, more than the file can hold");
  const std::string huge_tile = le<std::uint32_t>(1u << 20) + le<std::uint32_t>(1u << 20) + std::string(1, '\0');
  EXPECT_EQ(refusal(header({.version = 0x202,
                            .channels = r,
                            .data_window = box(0, 0, 1, 1),
                            .more = attribute("tiles", "tiledesc", huge_tile)})),
            "the tiles are too large");
  std::string long_text = attribute("owner", "string", "nobody");
  long_text.replace(std::string("owner\0string\0", 13).size(), 4, le<std::int32_t>(0x7fffffff));
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, 1, 1), .more = long_text})),
            "attribute 'owner' is longer than the file");
  const std::string long_entry = attribute("views", "stringvector", le<std::int32_t>(0x7fffffff) + "left");
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, 1, 1), .more = long_entry})),
            "a text in 'views' is longer than 'views'");
  const std::string preview =
      attribute("preview", "preview", le<std::uint32_t>(0xffffffff) + le<std::uint32_t>(0xffffffff));
  EXPECT_EQ(refusal(header({.channels = r, .data_window = box(0, 0, 1, 1), .more = preview})),
            "the preview picture has a wrong size");
  EXPECT_EQ(refusal(header({.version = 0x1002, .channels = r, .data_window = box(0, 0, 1, 1)})),
            "deep and multi-part files are not supported");
}

TEST(Exr, RefusesTablesThatPointNowhere) {
  const std::string head = header({.channels = channel("R", float_type), .data_window = box(0, 0, 99, 1)});
  const std::string line = le<std::int32_t>(0) + le<std::int32_t>(400) + std::string(400, '\0');
  const std::uint64_t first = head.size() + 16, second = first + line.size(), end = second + line.size();
  const auto refusal = [&](std::uint64_t a, std::uint64_t b) {
    put(temporary("a.exr"), head + le(a) + le(b) + line + le<std::int32_t>(1) + line.substr(4));
    return failure_of(temporary("a.exr"));
  };
  EXPECT_EQ(refusal(first, second), "");
  const std::string reason = ": cannot read EXR: the file is not complete: some of its pixels are not in it";
  EXPECT_EQ(refusal(0, 0), temporary("a.exr") + reason);
  EXPECT_EQ(refusal(first, 0), temporary("a.exr") + reason);
  EXPECT_EQ(refusal(first, end), temporary("a.exr") + reason);
}

TEST(Exr, NamesWhatIsNoExr) {
  put(temporary("a.exr"), "PNG or so, but certainly nothing that begins as an OpenEXR file does");
  EXPECT_EQ(failure_of(temporary("a.exr")), temporary("a.exr") + ": cannot read EXR: not an OpenEXR file");
  put(temporary("a.exr"), "");
  EXPECT_EQ(failure_of(temporary("a.exr")), temporary("a.exr") + ": cannot read EXR: not an OpenEXR file");
  EXPECT_EQ(failure_of("/no/such/file.exr"), "/no/such/file.exr: cannot read: No such file or directory");
  EXPECT_EQ(failure_of(testing::TempDir()), testing::TempDir() + ": cannot read: Is a directory");
}

TEST(Exr, FailedWriteLeavesNothing) {
  ExrFile file;
  file.width = file.height = 1;
  file.add("R", {1});
  EXPECT_THROW(write_exr("/no/such/folder/a.exr", file), UserError);
  file.add("", {1});  // OpenEXR refuses a channel without a name, after the file has been opened
  const std::string path = temporary("a.exr");
  EXPECT_THROW(write_exr(path, file), UserError);
  const auto folder = std::filesystem::directory_iterator(testing::TempDir());
  EXPECT_EQ(std::count_if(begin(folder), end(folder), [&](const auto& e) { return e.path().string().find(path) == 0; }),
            0);
}

}  // namespace
}  // namespace isophote
