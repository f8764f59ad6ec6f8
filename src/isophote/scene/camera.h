#pragma once

#include <string>

#include "isophote/core/ray.h"
#include "isophote/core/vec.h"

namespace isophote {

/// A pinhole. `right`, `up`, `forward` are orthonormal; the picture's top is towards `up`.
struct Camera {
  std::string name;
  Vec3 eye{0, 0, 0};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  float fov_y = 0.8f;  ///< vertical field of view, radians
  float aspect = 0;    ///< width / height as authored; 0: any

  static Camera look_at(const Vec3& eye, const Vec3& target, float fov_y);

  /// The ray through the point (x, y) of a width x height picture, in pixels from the top left.
  Ray ray(float x, float y, int width, int height) const;
  /// The angle, in radians, that a pixel at the picture's middle spans.
  float pixel_angle(int height) const;
};

}  // namespace isophote
