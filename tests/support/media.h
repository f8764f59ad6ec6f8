#pragma once

#include "support/scenes.h"

// Media made in code.
namespace isophote::scenes {

inline Medium medium(const Rgb& scattering, const Rgb& absorption, const Box& bounds, float g = 0) {
  Medium m;
  m.scattering = scattering;
  m.absorption = absorption;
  m.g = g;
  m.bounds = bounds;
  return m;
}

/// Light of radiance 1 from everywhere, and a medium in a cube from -1 to 1.
inline Scene cloud_under_a_white_sky(const Medium& medium) {
  Scene scene;
  scene.environment.radiance = RgbImage(8, 4);
  for (Rgb& pixel : scene.environment.radiance.pixels) pixel = Rgb(1.0f);
  scene.media.push_back(medium);
  scene.cameras.push_back(Camera::look_at({0, 0, 4}, {0, 0, 0}, 0.5f));
  return scene;
}

/// The closed surface of a box.
inline ClosedMesh closed_box(const Vec3& lower, const Vec3& upper) {
  const Mesh sides = box(lower, upper, false, 0);
  return {sides.positions, sides.triangles};
}

}  // namespace isophote::scenes
