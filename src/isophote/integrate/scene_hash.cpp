#include "isophote/integrate/scene_hash.h"

#include <bit>
#include <cstring>
#include <span>

#include "isophote/core/hash.h"
#include "isophote/scene/density_grid.h"

namespace isophote {
namespace {

/// Takes in numbers one by one. Structs go in member by member, since their padding is not defined.
class Hasher {
 public:
  void add(std::uint64_t v) { state_ = mix_bits(state_ ^ v) + 0x9e3779b97f4a7c15ull; }
  void add(float v) { add(std::uint64_t{std::bit_cast<std::uint32_t>(v)}); }
  void add(const Vec2& v) { add(v.x), add(v.y); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const Rgb& c) { add(c.r), add(c.g), add(c.b); }
  void add(const Rgba& c) { add(c.color), add(c.alpha); }
  void add(const std::array<std::uint32_t, 3>& t) { add((std::uint64_t{t[0]} << 32) | t[1]), add(std::uint64_t{t[2]}); }
  void add(const TextureUse& t) {
    add(static_cast<std::uint64_t>(t.texture)), add(static_cast<std::uint64_t>(t.uv_set));
    for (const float m : t.matrix) add(m);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t{values.size()});
    for (const T& v : values) add(v);
  }
  void add_bytes(std::span<const std::uint8_t> bytes) {
    add(std::uint64_t{bytes.size()});
    while (!bytes.empty()) {
      std::uint64_t word = 0;
      const std::size_t n = std::min<std::size_t>(8, bytes.size());
      std::memcpy(&word, bytes.data(), n);
      add(word);
      bytes = bytes.subspan(n);
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

void add_mesh(Hasher& h, const Mesh& m) {
  h.add(static_cast<std::uint64_t>(m.material));
  h.add(m.positions), h.add(m.normals), h.add(m.tangents), h.add(m.tangent_signs);
  h.add(m.uv[0]), h.add(m.uv[1]), h.add(m.colors), h.add(m.triangles);
}

void add_material(Hasher& h, const Material& m) {
  h.add(m.base_color), h.add(m.base_alpha), h.add(m.metallic), h.add(m.roughness), h.add(m.normal_scale),
      h.add(m.emission);
  for (const TextureUse* t :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture,
        &m.specular_texture, &m.specular_color_texture, &m.transmission_texture})
    h.add(*t);
  h.add(std::uint64_t{m.double_sided}), h.add(static_cast<std::uint64_t>(m.alpha)), h.add(m.alpha_cutoff);
  h.add(m.specular), h.add(m.specular_color), h.add(m.ior), h.add(m.transmission);
  h.add(std::uint64_t{m.solid}), h.add(m.attenuation_color), h.add(m.attenuation_distance);
}

void add_texture(Hasher& h, const Texture& t) {
  h.add(static_cast<std::uint64_t>(t.width)), h.add(std::uint64_t{t.srgb});
  h.add(static_cast<std::uint64_t>(t.wrap_u)), h.add(static_cast<std::uint64_t>(t.wrap_v));
  h.add_bytes(t.rgba);
}

void add_light(Hasher& h, const PunctualLight& l) {
  h.add(static_cast<std::uint64_t>(l.kind)), h.add(l.position), h.add(l.direction), h.add(l.intensity);
  h.add(l.inner_cone), h.add(l.outer_cone), h.add(l.range);
}

/// Which alternative it holds, and what that says.
void add_density(Hasher& h, const Medium& m) {
  h.add(std::uint64_t{m.density.index()});
  if (const auto* height = std::get_if<HeightDensity>(&m.density)) h.add(height->base), h.add(height->height);
  if (const auto* grid = std::get_if<GridDensity>(&m.density)) h.add((*grid)->content_hash());
}

void add_bounds(Hasher& h, const Medium& m) {
  h.add(std::uint64_t{m.bounds.index()});
  if (const auto* box = std::get_if<Box>(&m.bounds)) h.add(box->lower), h.add(box->upper);
  if (const auto* mesh = std::get_if<ClosedMesh>(&m.bounds)) h.add(mesh->positions), h.add(mesh->triangles);
}

void add_medium(Hasher& h, const Medium& m) {
  h.add(m.scattering), h.add(m.absorption), h.add(m.emission), h.add(m.g);
  add_density(h, m), add_bounds(h, m);
}

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
  Hasher h;
  for (const Mesh& m : scene.meshes) add_mesh(h, m);
  for (const Material& m : scene.materials) add_material(h, m);
  for (const Texture& t : scene.textures) add_texture(h, t);
  for (const PunctualLight& l : scene.lights) add_light(h, l);
  h.add(static_cast<std::uint64_t>(scene.environment.radiance.width));
  h.add(scene.environment.radiance.pixels), h.add(scene.environment.rotation);
  for (const Medium& m : scene.media) add_medium(h, m);
  return h.value();
}

}  // namespace isophote
