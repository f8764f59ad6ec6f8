#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isophote/core/rgb.h"
#include "isophote/core/vec.h"

namespace isophote {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An 8-bit RGBA picture, decoded to linear where it is fetched.
struct Texture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< width * height * 4, row by row from the top left
  bool srgb = false;               ///< colour channels are sRGB encoded; alpha never is
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

/// A use of a texture by a material. uv' = matrix * (uv, 1) (KHR_texture_transform); `texture` < 0: none, factor 1.
struct TextureUse {
  int texture = -1;
  int uv_set = 0;  ///< 0 or 1
  std::array<float, 6> matrix{1, 0, 0, 0, 1, 0};
};

/// Bilinear value, linear light: (colour, alpha).
struct Rgba {
  Rgb color;
  float alpha = 1;
};
Rgba fetch(const Texture& texture, Vec2 uv);

}  // namespace isophote
