#include "isophote/scene/lit_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

/// Black but for some texels; a width that blocks do not divide.
Texture sparse(Wrap wrap_u, Wrap wrap_v) {
  Texture texture;
  texture.width = 61, texture.height = 40;
  texture.wrap_u = wrap_u, texture.wrap_v = wrap_v;
  texture.rgba.assign(61 * 40 * 4, 0);
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) texture.rgba[i] = 255;  // alpha is no light
  const int lit[][2] = {{0, 0}, {60, 20}, {17, 9}, {30, 31}, {31, 39}};
  int channel = 0;
  for (const auto& [x, y] : lit) texture.rgba[(y * 61 + x) * 4 + channel++ % 3] = 1;
  return texture;
}

TEST(LitBlocks, MissesNoLight) {
  const Wrap wraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};
  Random random(7);
  int black = 0, lit = 0;
  for (int i = 0; i < 20000; ++i) {
    const Texture texture = sparse(wraps[i % 3], wraps[i / 3 % 3]);
    const LitBlocks blocks(texture);
    const Vec2 from = random.next2() * 6 - Vec2{3, 3}, size = random.next2() * (i % 2 ? 0.05f : 0.3f);
    bool seen = false;
    for (int k = 0; k < 50; ++k) {
      const Vec2 u = random.next2();
      seen |= !is_black(fetch(texture, {from.x + size.x * u.x, from.y + size.y * u.y}).color);
    }
    const bool may = blocks.lit(from, from + size);
    EXPECT_TRUE(may || !seen) << from.x << " " << from.y << " " << size.x << " " << size.y;
    (seen ? lit : black) += may == seen;
  }
  EXPECT_GT(lit, 2000);
  EXPECT_GT(black, 5000);  // and it is of use
}

TEST(LitBlocks, WholePeriodsAndAbsurdCoordinatesReachAllTexels) {
  const Texture texture = sparse(Wrap::repeat, Wrap::mirror);
  const LitBlocks blocks(texture);
  EXPECT_FALSE(blocks.lit({0.5f, 0.35f}, {0.6f, 0.4f}));
  EXPECT_TRUE(blocks.lit({0.5f, 0.35f}, {1.6f, 1.4f}));
  EXPECT_TRUE(blocks.lit({-INFINITY, -INFINITY}, {INFINITY, INFINITY}));
  EXPECT_TRUE(blocks.lit({NAN, NAN}, {NAN, NAN}));
  EXPECT_TRUE(blocks.lit({-3e38f, -3e38f}, {3e38f, 3e38f}));
}

}  // namespace
}  // namespace isophote
