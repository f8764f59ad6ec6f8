#include "isophote/image/false_colour.h"

#include <gtest/gtest.h>

namespace isophote {
namespace {

TEST(FalseColour, BrightensFromVioletToYellow) {
  const Rgb violet = false_colour(0), yellow = false_colour(1);
  EXPECT_LT(violet.g, violet.r);
  EXPECT_LT(violet.r, violet.b);
  EXPECT_LT(luminance(violet), 0.05f);
  EXPECT_GT(luminance(yellow), 0.7f);
  EXPECT_LT(yellow.b, 0.5f * yellow.r);
  for (int i = 1; i <= 100; ++i) {
    const Rgb before = false_colour(static_cast<float>(i - 1) / 100), here = false_colour(static_cast<float>(i) / 100);
    EXPECT_GT(luminance(here), luminance(before)) << i;
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(here[k] > 0 && here[k] < 1) << i;  // never clipped to the display's gamut
  }
}

TEST(FalseColour, ClampsItsArgument) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(false_colour(-3)[k], false_colour(0)[k], 1e-5f);
    EXPECT_NEAR(false_colour(7)[k], false_colour(1)[k], 1e-5f);
  }
}

TEST(ColourScale, LeavesOutTwoPercentAndWhatIsNotAboveZero) {
  std::vector<float> values{0, -1};
  for (int i = 1; i <= 100; ++i) values.push_back(static_cast<float>(i));
  const ColourScale linear = colour_scale(values, false), logarithmic = colour_scale(values, true);
  EXPECT_EQ(linear.low, 0);
  EXPECT_EQ(linear.high, 98);
  EXPECT_EQ(logarithmic.low, 3);
  EXPECT_EQ(logarithmic.high, 98);
  // Not bit for bit: a compiler may evaluate the constant and the variable differently.
  const auto expect_colour = [](const Rgb& seen, float t) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], false_colour(t)[k], 1e-5f);
  };
  expect_colour(linear(49), 0.5f);
  expect_colour(logarithmic(std::sqrt(3 * 98.0f)), 0.5f);
  for (const ColourScale& scale : {linear, logarithmic}) {
    expect_colour(scale(0), 0);
    expect_colour(scale(1e9f), 1);
  }
}

TEST(ColourScale, OfNothingAndOfOneValue) {
  for (const bool logarithmic : {false, true})
    for (const std::vector<float>& values : {std::vector<float>{}, std::vector<float>{7, 7, 7}}) {
      const ColourScale scale = colour_scale(values, logarithmic);
      EXPECT_LT(scale.low, scale.high);
      EXPECT_TRUE(is_finite(scale(7)));
    }
}

TEST(ErrorPicture, IsBlueWhereTooDarkAndRedWhereTooBright) {
  RgbImage reference(4, 1, Rgb(2.0f)), image(4, 1, Rgb(2.0f));
  image.pixels[1] = Rgb(2.5f);   // +25% of the mean, half the range
  image.pixels[2] = Rgb(1.5f);   // -25%
  image.pixels[3] = Rgb(20.0f);  // beyond the range
  const RgbImage picture = error_picture(image, reference, 0.5f);
  const auto expect = [&](int x, const Rgb& c) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(picture.at(x, 0)[k], c[k], 1e-6f) << x;
  };
  expect(0, {1, 1, 1});
  expect(1, {1, 0.5f, 0.5f});
  expect(2, {0.5f, 0.5f, 1});
  expect(3, {1, 0, 0});
}

TEST(ErrorPicture, OfABlackReference) {
  RgbImage reference(2, 1), image(2, 1);
  image.pixels[1] = Rgb(1e-6f);
  const RgbImage picture = error_picture(image, reference, 1);
  EXPECT_EQ(picture.at(0, 0), (Rgb{1, 1, 1}));
  EXPECT_EQ(picture.at(1, 0), (Rgb{1, 0, 0}));
}

}  // namespace
}  // namespace isophote
