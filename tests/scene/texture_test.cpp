#include "isophote/scene/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isophote {
namespace {

/// Two texels, red 0 and 255, side by side.
Texture step(Wrap wrap) {
  Texture texture;
  texture.width = 2, texture.height = 1;
  texture.rgba = {0, 0, 0, 255, 255, 0, 0, 51};
  texture.wrap_u = texture.wrap_v = wrap;
  return texture;
}
float red(const Texture& texture, float u) { return fetch(texture, {u, 0.5f}).color.r; }

TEST(Texture, TexelCentresAreExactAndBetweenIsLinear) {
  const Texture t = step(Wrap::clamp);
  EXPECT_EQ(red(t, 0.25f), 0);
  EXPECT_EQ(red(t, 0.75f), 1);
  EXPECT_FLOAT_EQ(red(t, 0.5f), 0.5f);
  EXPECT_FLOAT_EQ(red(t, 0.625f), 0.75f);
  EXPECT_FLOAT_EQ(fetch(t, {0.75f, 0.5f}).alpha, 0.2f);
}

TEST(Texture, Wraps) {
  EXPECT_EQ(red(step(Wrap::clamp), -3.0f), 0);
  EXPECT_EQ(red(step(Wrap::clamp), 1.9f), 1);
  EXPECT_FLOAT_EQ(red(step(Wrap::repeat), 1.0f), 0.5f);  // between the last and the first
  EXPECT_FLOAT_EQ(red(step(Wrap::repeat), -0.25f), 1);
  EXPECT_FLOAT_EQ(red(step(Wrap::repeat), 7.25f), 0);
  EXPECT_FLOAT_EQ(red(step(Wrap::mirror), 1.0f), 1);
  EXPECT_FLOAT_EQ(red(step(Wrap::mirror), 1.25f), 1);
  EXPECT_FLOAT_EQ(red(step(Wrap::mirror), 1.75f), 0);
  EXPECT_FLOAT_EQ(red(step(Wrap::mirror), -0.75f), 1);
  EXPECT_FLOAT_EQ(red(step(Wrap::mirror), 2.0f), 0);
}

TEST(Texture, DecodesSrgbColourButNotAlpha) {
  Texture t;
  t.width = t.height = 1;
  t.rgba = {188, 10, 255, 188};
  t.srgb = true;
  const Rgba value = fetch(t, {0.3f, 0.9f});
  EXPECT_NEAR(value.color.r, std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(value.color.g, 10 / 255.0 / 12.92, 1e-6);
  EXPECT_EQ(value.color.b, 1);  // white loses nothing
  EXPECT_FLOAT_EQ(value.alpha, 188 / 255.0f);
}

TEST(Texture, InterpolatesInLinearLight) {
  Texture t = step(Wrap::clamp);
  t.srgb = true;
  EXPECT_FLOAT_EQ(red(t, 0.5f), 0.5f);
}

TEST(Texture, RowsRunFromTheTop) {
  Texture t;
  t.width = 1, t.height = 2;
  t.rgba = {255, 0, 0, 255, 0, 0, 0, 255};
  t.wrap_v = Wrap::clamp;
  EXPECT_FLOAT_EQ(fetch(t, {0.5f, 0.1f}).color.r, 1);
  EXPECT_FLOAT_EQ(fetch(t, {0.5f, 0.9f}).color.r, 0);
}

TEST(Texture, SurvivesAnyCoordinate) {
  const float huge = std::numeric_limits<float>::max(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (const float u : {huge, -huge, nan, std::numeric_limits<float>::infinity(), -1e-30f, 1e7f}) {
      const float value = red(step(wrap), u);
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
}

}  // namespace
}  // namespace isophote
