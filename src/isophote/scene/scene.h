#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isophote/core/rgb.h"
#include "isophote/core/vec.h"
#include "isophote/image/image.h"
#include "isophote/scene/camera.h"
#include "isophote/scene/material.h"
#include "isophote/scene/medium.h"
#include "isophote/scene/texture.h"

namespace isophote {

/// Triangles of one material, in world space. Attribute arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::string node;  ///< what the instance is called
  int material = 0;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;         ///< unit
  std::vector<Vec3> tangents;        ///< unit; empty: derived from uv where a normal map needs it
  std::vector<float> tangent_signs;  ///< +-1, beside `tangents`
  std::array<std::vector<Vec2>, 2> uv;
  std::vector<Rgba> colors;  ///< linear
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// KHR_lights_punctual, in W/sr (point, spot: intensity) or W/m2 (directional: irradiance at normal incidence).
struct PunctualLight {
  enum class Kind : std::uint8_t { point, spot, directional };
  Kind kind = Kind::point;
  std::string name;
  Vec3 position;
  Vec3 direction{0, 0, -1};  ///< of propagation, unit
  Rgb intensity{1.0f};
  float inner_cone = 0, outer_cone = 0.785398f;  ///< radians
  float range = infinity;
};

/// Light from infinity: an equirectangular picture, its middle column towards -Z, its top row towards +Y, turned about
/// +Y by `rotation` (radians, counter-clockwise seen from above). Empty picture: black.
struct EnvironmentMap {
  RgbImage radiance;  ///< already multiplied by the intensity
  float rotation = 0;
};

/// Everything there is to see. Ids are indices into these arrays. `load/` makes and validates it; positions, normals
/// and colours are finite, triangle indices and ids are in range.
struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<PunctualLight> lights;
  EnvironmentMap environment;
  std::vector<Medium> media;    ///< at most 32
  std::vector<Camera> cameras;  ///< never empty after loading

  Box bounds() const;
  std::size_t triangle_count() const;
};

}  // namespace isophote
