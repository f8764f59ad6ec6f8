#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "isophote/core/check.h"
#include "isophote/load/gltf_materials.h"
#include "isophote/scene/scene.h"

/// What scene.h and its like promise of a loaded scene; aborts where it does not hold.
namespace isophote::fuzz {

inline bool is_unit(const Vec3& v) { return std::abs(length(v) - 1) < 1e-4f; }
/// A colour, or light: finite and not negative.
inline bool is_sound(const Rgb& c) { return is_finite(c) && std::min({c.r, c.g, c.b}) >= 0; }
inline bool in_unit(float v) { return v >= 0 && v <= 1; }
inline bool in_unit(const Rgb& c) { return is_sound(c) && max_component(c) <= 1; }

inline void check_mesh(const Scene& scene, const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  ISOPHOTE_CHECK(static_cast<std::size_t>(mesh.material), <, scene.materials.size());
  ISOPHOTE_CHECK(mesh.triangles.empty(), ==, false);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t id : triangle) ISOPHOTE_CHECK(id, <, vertices);
  for (const std::size_t size : {mesh.normals.size(), mesh.tangents.size(), mesh.tangent_signs.size(),
                                 mesh.uv[0].size(), mesh.uv[1].size(), mesh.colors.size()})
    if (size != 0) ISOPHOTE_CHECK(size, ==, vertices);
  ISOPHOTE_CHECK(mesh.tangents.size(), ==, mesh.tangent_signs.size());
  for (const Vec3& p : mesh.positions) ISOPHOTE_CHECK(is_finite(p), ==, true);
  for (const Vec3& n : mesh.normals) ISOPHOTE_CHECK(is_unit(n), ==, true);
  for (const Vec3& t : mesh.tangents) ISOPHOTE_CHECK(is_unit(t), ==, true);
  for (const float sign : mesh.tangent_signs) ISOPHOTE_CHECK(std::abs(sign), ==, 1);
  for (const auto& set : mesh.uv)
    for (const Vec2& uv : set) ISOPHOTE_CHECK(std::isfinite(uv.x) && std::isfinite(uv.y), ==, true);
  for (const Rgba& c : mesh.colors) ISOPHOTE_CHECK(in_unit(c.color) && in_unit(c.alpha), ==, true);
}

inline void check_material(const Scene& scene, const Material& m) {
  for (const TextureUse* use : texture_uses(m)) {
    ISOPHOTE_CHECK(use->texture, <, static_cast<int>(scene.textures.size()));
    ISOPHOTE_CHECK(use->uv_set == 0 || use->uv_set == 1, ==, true);
    for (const float v : use->matrix) ISOPHOTE_CHECK(std::isfinite(v), ==, true);
  }
  for (const float v : {m.base_alpha, m.metallic, m.roughness, m.specular, m.transmission})
    ISOPHOTE_CHECK(in_unit(v), ==, true);
  ISOPHOTE_CHECK(in_unit(m.base_color) && in_unit(m.attenuation_color), ==, true);
  ISOPHOTE_CHECK(is_sound(m.emission) && is_sound(m.specular_color), ==, true);
  ISOPHOTE_CHECK(std::isfinite(m.normal_scale) && std::isfinite(m.alpha_cutoff), ==, true);
  ISOPHOTE_CHECK(m.ior == 0 || (m.ior >= 1 && m.ior <= 1000), ==, true);
  ISOPHOTE_CHECK(m.attenuation_distance, >, 0);
}

inline void check_light(const PunctualLight& light) {
  ISOPHOTE_CHECK(is_finite(light.position), ==, true);
  ISOPHOTE_CHECK(is_unit(light.direction), ==, true);
  ISOPHOTE_CHECK(is_sound(light.intensity), ==, true);
  ISOPHOTE_CHECK(light.inner_cone, >=, 0);
  ISOPHOTE_CHECK(light.inner_cone, <=, light.outer_cone);
  ISOPHOTE_CHECK(light.outer_cone, <=, 1.5708f);
  ISOPHOTE_CHECK(light.range, >, 0);
}

inline void check_camera(const Camera& camera) {
  ISOPHOTE_CHECK(is_finite(camera.eye), ==, true);
  for (const Vec3& axis : {camera.right, camera.up, camera.forward}) ISOPHOTE_CHECK(is_unit(axis), ==, true);
  ISOPHOTE_CHECK(std::abs(dot(camera.right, camera.forward)), <, 1e-4f);
  ISOPHOTE_CHECK(camera.fov_y > 0 && camera.fov_y < 3.1416f, ==, true);
  ISOPHOTE_CHECK(camera.aspect >= 0 && std::isfinite(camera.aspect), ==, true);
}

inline void check_scene(const Scene& scene) {
  ISOPHOTE_CHECK(scene.cameras.empty(), ==, false);
  ISOPHOTE_CHECK(scene.meshes.empty(), ==, false);
  for (const Mesh& mesh : scene.meshes) check_mesh(scene, mesh);
  for (const Material& material : scene.materials) check_material(scene, material);
  for (const PunctualLight& light : scene.lights) check_light(light);
  for (const Camera& camera : scene.cameras) check_camera(camera);
  for (const Texture& texture : scene.textures)
    ISOPHOTE_CHECK(texture.rgba.size(), ==,
                   std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
}

}  // namespace isophote::fuzz
