#include "isophote/image/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "isophote/core/error.h"
#include "test_files.h"

namespace isophote {
namespace {

using testing_files::temporary;

struct Decoded {
  unsigned width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

Decoded decode(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&png, path.c_str())) << png.message;
  png.format = PNG_FORMAT_RGB;
  Decoded d{png.width, png.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, d.rgb.data(), 0, nullptr)) << png.message;
  return d;
}

TEST(Png, DecodesToTheBytesOfSrgb) {
  RgbImage image(3, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  image.pixels = {{0, 0.18f, 1}, {0.5f, 0.002f, 0.05f}, {-1, 7, 0.9f}, {nan, inf, -inf}, {1, 0, 0}, {0, 0, 1}};
  write_png(temporary("a.png"), image, 0);
  const Decoded d = decode(temporary("a.png"));
  EXPECT_EQ(d.width, 3u);
  EXPECT_EQ(d.height, 2u);
  // 255 times: 0.18 -> 0.4614, 0.5 -> 0.7354, 0.002 -> 12.92 * 0.002, 0.05 -> 0.2478, 0.9 -> 0.9547
  const std::vector<std::uint8_t> expected{0, 118, 255, 188, 7, 63, 0, 255, 243, 0, 255, 0, 255, 0, 0, 0, 0, 255};
  EXPECT_EQ(d.rgb, expected);
}

TEST(Png, ExposureIsInStops) {
  RgbImage image(1, 1), doubled(1, 1);
  image.pixels[0] = {0.02f, 0.1f, 0.11f};
  doubled.pixels[0] = image.pixels[0] * 8.0f;
  write_png(temporary("a.png"), image, 3);
  write_png(temporary("b.png"), doubled, 0);
  EXPECT_EQ(decode(temporary("a.png")).rgb, decode(temporary("b.png")).rgb);
  EXPECT_GT(decode(temporary("a.png")).rgb[0], 0);
}

TEST(Png, AutoExposureBringsThe95thPercentileToEightTenths) {
  RgbImage image(10, 20);
  for (int i = 0; i < 101; ++i)
    image.pixels[static_cast<std::size_t>(i)] = Rgb(static_cast<float>(i + 1));  // the rest is black
  EXPECT_NEAR(auto_exposure(image), std::log2(0.8 / 96), 1e-6);
  EXPECT_EQ(auto_exposure(RgbImage(4, 4)), 0.0f);
  image.pixels[199] = Rgb(std::numeric_limits<float>::infinity());
  EXPECT_NEAR(auto_exposure(image), std::log2(0.8 / 96), 1e-6);
}

TEST(Png, NamesThePathThatCannotBeWritten) {
  try {
    write_png("/no/such/folder/a.png", RgbImage(2, 2), 0);
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "/no/such/folder/a.png: cannot write: No such file or directory");
  }
}

}  // namespace
}  // namespace isophote
