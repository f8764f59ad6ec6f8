#include "isophote/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "isophote/core/error.h"
#include "isophote/core/hash.h"

namespace isophote {
namespace {

RgbImage make(int width, int height, const std::function<Rgb(int, int)>& value) {
  RgbImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = value(x, y);
  return image;
}
Rgb uneven(int x, int y) { return {0.5f + 0.25f * static_cast<float>(x % 3), 1 + 0.5f * static_cast<float>(y % 2), 2}; }

TEST(Metrics, IdenticalPicturesDoNotDiffer) {
  const Difference d = compare(make(33, 21, uneven), make(33, 21, uneven));
  EXPECT_EQ(d.rmse, 0);
  EXPECT_EQ(d.relative_rmse, 0);
  EXPECT_EQ(d.relative_mse, 0);
  EXPECT_EQ(d.bias, 0);
  EXPECT_EQ(d.block_error, 0);
  EXPECT_DOUBLE_EQ(d.ssim, 1);
}

TEST(Metrics, ConstantOffset) {
  // Reference 2 everywhere, picture 2.5 in red alone: luminance differs by 0.2126 / 2.
  const auto reference = make(20, 20, [](int, int) { return Rgb{2, 2, 2}; });
  const Difference d = compare(make(20, 20, [](int, int) { return Rgb{2.5f, 2, 2}; }), reference);
  const double step = 0.2126 * 0.5;
  EXPECT_NEAR(d.rmse, 0.5 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.relative_rmse, 0.25 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.bias, step / 2, 1e-12);
  EXPECT_NEAR(d.relative_mse, step * step / (4 + 0.02 * 0.02), 1e-12);
  EXPECT_NEAR(d.block_error, step / 2, 1e-12);
  EXPECT_LT(compare(make(20, 20, [](int, int) { return Rgb(1.5f); }), reference).bias, 0);
}

TEST(Metrics, CheckerboardAveragesOutInBlocksButBlotchesDoNot) {
  const auto reference = make(64, 32, [](int, int) { return Rgb(1.0f); });
  const auto squares = [&](int side) {
    return compare(make(64, 32, [&](int x, int y) { return Rgb((x / side + y / side) % 2 ? 1.25f : 0.75f); }),
                   reference);
  };
  EXPECT_NEAR(squares(1).rmse, 0.25, 1e-12);
  EXPECT_NEAR(squares(8).rmse, 0.25, 1e-12);
  EXPECT_EQ(squares(1).block_error, 0);
  EXPECT_NEAR(squares(8).block_error, 0.25, 1e-12);
}

TEST(Metrics, RelativeErrorWeighsDarkPixelsAsMuchAsBrightOnes) {
  // Half the picture at 0.5, half at 1.5 (mean 1), each 10% too bright.
  const auto reference = make(8, 8, [](int x, int) { return Rgb(x < 4 ? 0.5f : 1.5f); });
  const auto image = make(8, 8, [](int x, int) { return Rgb(x < 4 ? 0.55f : 1.65f); });
  const double expected = 0.5 * (0.0025 / (0.25 + 1e-4) + 0.0225 / (2.25 + 1e-4));
  EXPECT_NEAR(compare(image, reference).relative_mse, expected, 1e-7);
}

// The expected values come from the definition, written out as sums over two-dimensional windows in double precision.
TEST(Metrics, StructuralSimilarityAgreesWithTheDefinition) {
  const auto value = [](int x, int y) { return static_cast<float>((x * 7 + y * 13 + x * y * 5) % 32) / 40; };
  const auto other = [&](int x, int y) { return 0.9f * value(x, y) + static_cast<float>((x * 11 + y * 3) % 8) / 80; };
  const auto ssim = [&](int height, float scale) {
    return compare(make(17, height, [&](int x, int y) { return Rgb(scale * other(x, y)); }),
                   make(17, height, [&](int x, int y) { return Rgb(scale * value(x, y)); }))
        .ssim;
  };
  EXPECT_NEAR(ssim(14, 1), 0.9768218949215333, 1e-6);
  EXPECT_NEAR(ssim(7, 1), 0.9672613908966218, 1e-6);  // a side shorter than the window
  EXPECT_NEAR(ssim(14, 1024), ssim(14, 1), 1e-7);     // no unit of the scene; the exposure rounds to a float
}

TEST(Metrics, NoiseLowersStructuralSimilarity) {
  const auto smooth = [](int x, int y) { return Rgb(0.2f + 0.01f * static_cast<float>(x + y)); };
  const auto noisy = [&](float amount) {
    return make(32, 32, [&, amount](int x, int y) {
      const auto seed = hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
      return smooth(x, y) + Rgb(amount * (unit_float(static_cast<std::uint32_t>(seed)) - 0.5f));
    });
  };
  const auto reference = make(32, 32, smooth);
  const double little = compare(noisy(0.02f), reference).ssim, much = compare(noisy(0.2f), reference).ssim;
  EXPECT_LT(little, 0.999);
  EXPECT_LT(much, little - 0.2);
  EXPECT_GT(much, 0);
}

// Both pictures are brighter by a quarter in blotches and noisy by themselves; so are both references.
TEST(Metrics, WhatTwoPicturesHaveInCommonIsSystematic) {
  const auto noisy = [](std::uint64_t seed, float blotch) {
    return make(256, 256, [=](int x, int y) {
      const float noise = unit_float(static_cast<std::uint32_t>(hash(seed, x, y))) - 0.5f;
      return Rgb(2 + noise + (x / 64 % 2 ? blotch : -blotch));
    });
  };
  const RgbImage a = noisy(1, 0.25f), b = noisy(2, 0.25f), first = noisy(3, 0), second = noisy(4, 0);
  const double noise = 1 / std::sqrt(12.0);
  EXPECT_NEAR(compare(a, first, second).relative_rmse, std::hypot(0.25, noise) / 2, 2e-3);
  EXPECT_NEAR(compare(a, b, first, second).relative_rmse, 0.125, 2e-3);
  EXPECT_NEAR(compare(a, b, first, second).block_error, 0.125, 2e-3);
  EXPECT_LT(compare(noisy(5, 0), noisy(6, 0), first, second).relative_rmse, 0.02);
}

TEST(Metrics, BlackReference) {
  const RgbImage black(9, 9);
  EXPECT_EQ(compare(black, black).relative_rmse, 0);
  EXPECT_EQ(compare(black, black).bias, 0);
  const Difference d = compare(make(9, 9, [](int, int) { return Rgb(1.0f); }), black);
  EXPECT_NEAR(d.rmse, 1, 1e-12);
  EXPECT_TRUE(std::isinf(d.bias) && std::isinf(d.relative_rmse) && std::isinf(d.block_error) &&
              std::isinf(d.relative_mse));
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  const auto reason = [](const RgbImage& a, const RgbImage& b) -> std::string {
    try {
      compare(a, b);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(reason(RgbImage(4, 3), RgbImage(3, 4)), "the picture is 4x3 and the reference 3x4");
  RgbImage broken(5, 4);
  broken.at(3, 2).g = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(reason(broken, RgbImage(5, 4)), "pixel (3, 2) of the picture is not finite");
  EXPECT_EQ(reason(RgbImage(5, 4), broken), "pixel (3, 2) of the reference is not finite");
}

TEST(Metrics, BlockAverageCutsIncompleteBlocks) {
  const RgbImage means = block_average(make(5, 3, [](int x, int y) { return Rgb(static_cast<float>(10 * y + x)); }), 2);
  ASSERT_EQ(means.width, 3);
  ASSERT_EQ(means.height, 2);
  EXPECT_EQ(means.at(0, 0), Rgb(5.5f));   // 0, 1, 10, 11
  EXPECT_EQ(means.at(2, 0), Rgb(9.0f));   // 4, 14
  EXPECT_EQ(means.at(1, 1), Rgb(22.5f));  // 22, 23
  EXPECT_EQ(means.at(2, 1), Rgb(24.0f));
}

}  // namespace
}  // namespace isophote
