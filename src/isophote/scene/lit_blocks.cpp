#include "isophote/scene/lit_blocks.h"

#include <algorithm>
#include <cmath>

namespace isophote {
namespace {

constexpr int block = 4;  // texels along a side

struct Span {
  int first, last;
};

/// The texels along one axis that interpolation reaches from coordinates between `lower` and `upper`, the whole axis
/// where they are not in one period.
Span reached(float lower, float upper, int size, Wrap wrap) {
  const Span all{0, size - 1};
  // Half a texel is interpolation's, one is left to rounding.
  const double first = static_cast<double>(lower) * size - 1.5, last = static_cast<double>(upper) * size + 1.5;
  if (!(last - first < size)) return all;
  if (wrap == Wrap::clamp)
    return {static_cast<int>(std::clamp(first, 0.0, size - 1.0)), static_cast<int>(std::clamp(last, 0.0, size - 1.0))};
  const double period = std::floor(first / size);
  if (!(last < (period + 1) * size)) return all;
  const int a = static_cast<int>(first - period * size), b = static_cast<int>(last - period * size);
  const bool mirrored = wrap == Wrap::mirror && std::fmod(period, 2) != 0;
  return mirrored ? Span{size - 1 - b, size - 1 - a} : Span{a, b};
}

}  // namespace

LitBlocks::LitBlocks(const Texture& texture)
    : width_(texture.width),
      height_(texture.height),
      wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v),
      columns_((texture.width + block - 1) / block),
      rows_((texture.height + block - 1) / block),
      sums_(static_cast<std::size_t>(columns_ + 1) * (rows_ + 1)) {
  const std::uint8_t* texel = texture.rgba.data();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, texel += 4)
      if ((texel[0] | texel[1] | texel[2]) != 0) sum(x / block + 1, y / block + 1) = 1;
  for (int row = 1; row <= rows_; ++row)
    for (int column = 1; column <= columns_; ++column)
      sum(column, row) += sum(column - 1, row) + sum(column, row - 1) - sum(column - 1, row - 1);
}

bool LitBlocks::lit(Vec2 lower, Vec2 upper) const {
  const Span x = reached(lower.x, upper.x, width_, wrap_u_), y = reached(lower.y, upper.y, height_, wrap_v_);
  const int left = x.first / block, right = x.last / block + 1, top = y.first / block, bottom = y.last / block + 1;
  return sum(right, bottom) + sum(left, top) != sum(left, bottom) + sum(right, top);
}

}  // namespace isophote
