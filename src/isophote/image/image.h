#pragma once

#include <cstddef>
#include <vector>

#include "isophote/core/rgb.h"

namespace isophote {

/// A rectangle of values, row by row from the top left.
template <class T>
struct Image {
  int width = 0, height = 0;
  std::vector<T> pixels;

  Image() = default;
  Image(int width_, int height_, T fill = T{})
      : width(width_), height(height_), pixels(static_cast<std::size_t>(width_) * height_, fill) {}

  T& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const T& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

using RgbImage = Image<Rgb>;

}  // namespace isophote
