#include "isophote/scene/texture.h"

#include <algorithm>
#include <cmath>

#include "isophote/image/srgb.h"

namespace isophote {
namespace {

std::array<float, 256> srgb_table() {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[i] = srgb_decode(static_cast<float>(i) / 255);
  return table;
}
std::array<float, 256> linear_table() {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(i / 255.0);
  return table;
}

/// Brings a coordinate into a few periods of the picture, so that texel indices fit an int whatever the file says.
float reduce(float t, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::min(1.0f, std::max(0.0f, t));
  const float period = wrap == Wrap::repeat ? 1.0f : 2.0f;
  const float reduced = t - period * std::floor(t / period);
  return reduced >= 0 && reduced <= period ? reduced : 0.0f;
}

/// The texel that index `i`, at most one period outside, stands for.
int wrapped(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
  if (wrap == Wrap::repeat) return i < 0 ? i + size : i >= size ? i - size : i;
  const int period = 2 * size, j = i < 0 ? i + period : i >= period ? i - period : i;
  return j < size ? j : period - 1 - j;
}

}  // namespace

Rgba fetch(const Texture& texture, Vec2 uv) {
  static const std::array<float, 256> srgb = srgb_table(), linear = linear_table();
  const std::array<float, 256>& decode = texture.srgb ? srgb : linear;

  const float x = reduce(uv.x, texture.wrap_u) * static_cast<float>(texture.width) - 0.5f;
  const float y = reduce(uv.y, texture.wrap_v) * static_cast<float>(texture.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int columns[] = {wrapped(static_cast<int>(left), texture.width, texture.wrap_u),
                         wrapped(static_cast<int>(left) + 1, texture.width, texture.wrap_u)};
  const int rows[] = {wrapped(static_cast<int>(top), texture.height, texture.wrap_v),
                      wrapped(static_cast<int>(top) + 1, texture.height, texture.wrap_v)};
  Rgba sum{Rgb{}, 0};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const float weight = (i == 0 ? 1 - fx : fx) * (j == 0 ? 1 - fy : fy);
      const std::uint8_t* texel =
          texture.rgba.data() + (static_cast<std::size_t>(rows[j]) * texture.width + columns[i]) * 4;
      sum.color += Rgb(decode[texel[0]], decode[texel[1]], decode[texel[2]]) * weight;
      sum.alpha += linear[texel[3]] * weight;
    }
  return sum;
}

}  // namespace isophote
