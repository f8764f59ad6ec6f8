#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "isophote/scene/scene.h"

// Scenes made in code, small and of known answers. Lengths are multiplied by `scale` where a function takes one.
namespace isophote::scenes {

inline Material diffuse(const Rgb& albedo) {
  Material material;
  material.base_color = albedo;
  material.metallic = 0;
  material.specular = 0;
  return material;
}
inline Material emissive(const Rgb& albedo, const Rgb& radiance) {
  Material material = diffuse(albedo);
  material.emission = radiance;
  return material;
}
inline Material metal(const Rgb& base, float roughness) {
  Material material;
  material.base_color = base;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}
/// Smooth, solid.
inline Material glass(float ior) {
  Material material;
  material.metallic = 0;
  material.roughness = 0;
  material.transmission = 1;
  material.ior = ior;
  material.solid = true;
  return material;
}

/// Adds the material and returns its id.
inline int add(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

/// The parallelogram origin, origin + a, origin + a + b, origin + b; its winding faces cross(a, b). uv runs along a and
/// b.
inline Mesh quad(const Vec3& origin, const Vec3& a, const Vec3& b, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {origin, origin + a, origin + a + b, origin + b};
  mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A `quad` in 2 n^2 triangles.
inline Mesh divided(const Mesh& quad, int n) {
  Mesh mesh;
  mesh.material = quad.material;
  const Vec3 &o = quad.positions[0], s = quad.positions[1] - o, t = quad.positions[3] - o;
  const float size = 1 / static_cast<float>(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      const Vec3 corner = o + s * (i * size) + t * (j * size);
      mesh.positions.insert(mesh.positions.end(),
                            {corner, corner + s * size, corner + (s + t) * size, corner + t * size});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  return mesh;
}

/// The six sides of a box; their winding faces inwards or outwards.
inline Mesh box(const Vec3& lower, const Vec3& upper, bool inwards, int material) {
  const Vec3 s = upper - lower, x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  Mesh mesh;
  mesh.material = material;
  const std::array<std::array<Vec3, 3>, 6> sides{
      {{lower, x, z}, {lower + y, z, x}, {lower, y, x}, {lower + z, x, y}, {lower, z, y}, {lower + x, y, z}}};
  for (const auto& [origin, a, b] : sides) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : {origin, origin + a, origin + a + b, origin + b}) mesh.positions.push_back(p);
    for (const std::array<std::uint32_t, 3>& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      const std::array<std::uint32_t, 3> out{first + t[0], first + t[1], first + t[2]};
      mesh.triangles.push_back(inwards ? std::array<std::uint32_t, 3>{out[0], out[2], out[1]} : out);
    }
  }
  return mesh;
}

/// A closed box from -1 to 1 of one material, seen from inside.
inline Scene room(const Material& walls) {
  Scene scene;
  scene.meshes.push_back(box({-1, -1, -1}, {1, 1, 1}, true, add(scene, walls)));
  scene.cameras.push_back(Camera::look_at({0, 0, 0.9f}, {0, 0, 0}, 1.2f));
  return scene;
}

/// A room in the manner of the Cornell box, two blocks in it, the lamp under the ceiling; open in front, 2 high.
inline Scene cornell_box(float scale = 1) {
  Scene scene;
  const int white = add(scene, diffuse(Rgb(0.73f))), red = add(scene, diffuse({0.63f, 0.06f, 0.05f}));
  const int green = add(scene, diffuse({0.14f, 0.45f, 0.09f})), lamp = add(scene, emissive(Rgb(0.0f), {17, 12, 4}));
  scene.meshes = {quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, white),
                  quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white),
                  quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white),
                  quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, red),
                  quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, green),
                  quad({-0.25f, 1.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}, lamp),
                  box({-0.7f, 0, -0.6f}, {-0.1f, 1.2f, 0}, false, white),
                  box({0.1f, 0, 0}, {0.7f, 0.6f, 0.6f}, false, white)};
  for (Mesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) p *= scale;
  scene.cameras.push_back(Camera::look_at(Vec3{0, 1, 4} * scale, Vec3{0, 1, 0} * scale, 0.68f));
  return scene;
}

}  // namespace isophote::scenes
