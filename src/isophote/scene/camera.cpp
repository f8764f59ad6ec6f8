#include "isophote/scene/camera.h"

#include <cmath>

namespace isophote {

Camera Camera::look_at(const Vec3& eye, const Vec3& target, float fov_y) {
  Camera camera;
  camera.eye = eye;
  camera.fov_y = fov_y;
  camera.forward = normalize(target - eye);
  // Straight up or down, the picture's top is towards -Z, as on a map.
  const Vec3 up = std::abs(camera.forward.y) < 0.9999f ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  camera.right = normalize(cross(camera.forward, up));
  camera.up = cross(camera.right, camera.forward);
  return camera;
}

Ray Camera::ray(float x, float y, int width, int height) const {
  const float half = std::tan(0.5f * fov_y);
  const float across = (2 * x - static_cast<float>(width)) / static_cast<float>(height) * half;
  const float along = (1 - 2 * y / static_cast<float>(height)) * half;
  return {eye, normalize(forward + right * across + up * along)};
}

float Camera::pixel_angle(int height) const {
  return 2 * std::atan(std::tan(0.5f * fov_y) / static_cast<float>(height));
}

}  // namespace isophote
