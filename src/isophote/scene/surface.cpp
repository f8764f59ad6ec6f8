#include "isophote/scene/surface.h"

#include <algorithm>
#include <cmath>

namespace isophote {
namespace {

/// The triangle of a hit, and what its vertices carry, interpolated there.
class Corners {
 public:
  Corners(const Scene& scene, const Hit& hit)
      : scene_(scene), mesh_(scene.meshes[hit.mesh]), ids_(mesh_.triangles[hit.triangle]), u_(hit.u), v_(hit.v) {}

  const Mesh& mesh() const { return mesh_; }
  const Material& material() const { return scene_.materials[mesh_.material]; }
  template <class T>
  const T& corner(const std::vector<T>& attribute, int i) const {
    return attribute[ids_[i]];
  }
  template <class T>
  T interpolate(const std::vector<T>& attribute) const {
    return corner(attribute, 0) * (1 - u_ - v_) + corner(attribute, 1) * u_ + corner(attribute, 2) * v_;
  }
  Rgba color() const {
    if (mesh_.colors.empty()) return {Rgb(1.0f), 1};
    const Rgba &a = corner(mesh_.colors, 0), &b = corner(mesh_.colors, 1), &c = corner(mesh_.colors, 2);
    const float w = 1 - u_ - v_;
    return {a.color * w + b.color * u_ + c.color * v_, a.alpha * w + b.alpha * u_ + c.alpha * v_};
  }
  /// White where the material uses no texture here or the mesh has no coordinates for it.
  Rgba texture(const TextureUse& use) const {
    if (use.texture < 0 || mesh_.uv[use.uv_set].empty()) return {Rgb(1.0f), 1};
    const Vec2 uv = interpolate(mesh_.uv[use.uv_set]);
    const auto& m = use.matrix;
    return fetch(scene_.textures[use.texture], {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]});
  }

 private:
  const Scene& scene_;
  const Mesh& mesh_;
  std::array<std::uint32_t, 3> ids_;
  float u_, v_;
};

struct Tangents {
  Vec3 along, across;  // unit, towards growing u and (as glTF has it) shrinking v of the texture; zero: none
};

/// A difference of texture coordinates as the texture's transform has it.
Vec2 turned(const TextureUse& use, const Vec2& d) {
  const auto& m = use.matrix;
  return {m[0] * d.x + m[1] * d.y, m[3] * d.x + m[4] * d.y};
}

/// `normal` is the interpolated one as authored; the tangents are made orthogonal to it. Authored ones are taken as
/// they are, derived ones follow the texture's transform.
Tangents tangents(const Corners& at, const Vec3& normal, const TextureUse& use) {
  const Mesh& mesh = at.mesh();
  Vec3 tangent;
  float sign = 1;
  if (!mesh.tangents.empty()) {
    tangent = at.interpolate(mesh.tangents);
    sign = at.corner(mesh.tangent_signs, 0);
  } else {
    const auto& uv = mesh.uv[use.uv_set];
    const Vec3 p = at.corner(mesh.positions, 0), e1 = at.corner(mesh.positions, 1) - p,
               e2 = at.corner(mesh.positions, 2) - p;
    const Vec2 t = at.corner(uv, 0), d1 = turned(use, at.corner(uv, 1) - t), d2 = turned(use, at.corner(uv, 2) - t);
    const float turn = d1.x * d2.y - d2.x * d1.y > 0 ? 1.0f : -1.0f;
    tangent = (e1 * d2.y - e2 * d1.y) * turn;
    const Vec3 down = (e2 * d1.x - e1 * d2.x) * turn;
    sign = dot(cross(normal, tangent), down) < 0 ? 1.0f : -1.0f;
  }
  tangent = tangent - normal * dot(tangent, normal);
  const float size = length(tangent);
  if (!(size > 0)) return {};
  return {tangent / size, cross(normal, tangent / size) * sign};
}

/// The normal that the material's normal texture makes of the interpolated one, both as authored.
Vec3 mapped_normal(const Corners& at, const Vec3& normal) {
  const TextureUse& use = at.material().normal_texture;
  if (use.texture < 0 || at.mesh().uv[use.uv_set].empty()) return normal;
  const Tangents frame = tangents(at, normal, use);
  const Rgb texel = at.texture(use).color;
  const float scale = at.material().normal_scale;
  const Vec3 mapped = frame.along * ((2 * texel.r - 1) * scale) + frame.across * ((2 * texel.g - 1) * scale) +
                      normal * (2 * texel.b - 1);
  const float size = length(mapped);
  return size > 0 ? mapped / size : normal;
}

/// `normal` turned towards `wo` by as little as leaves wo above its horizon: interpolated and mapped normals may not
/// face the viewer.
Vec3 facing(const Vec3& normal, const Vec3& wo) {
  constexpr float least_cosine = 1e-3f;
  const float cosine = dot(normal, wo);
  return cosine >= least_cosine ? normal : normalize(normal + wo * (2 * least_cosine - cosine));
}

Rgb absorption(const Material& material) {
  const bool filled = material.solid && material.transmission > 0;
  if (!filled || material.attenuation_distance == infinity) return Rgb(0.0f);
  constexpr float least = 1e-6f;  // of a channel: black would absorb infinitely
  const auto channel = [&](float c) { return -std::log(std::clamp(c, least, 1.0f)) / material.attenuation_distance; };
  const Rgb& c = material.attenuation_color;
  return {channel(c.r), channel(c.g), channel(c.b)};
}

/// The barycentric coordinates of a hit, moved off the triangle's edges by more than rounding could move a point. At an
/// edge walls meet, and a point that rounds onto the wrong side of the next wall sees through it. The right side is the
/// one the ray came from, which may lie beyond the edge: where several walls are equally near, the ray tracer may give
/// one behind another.
Vec2 off_edges(const Hit& hit, const Vec3& p, const Vec3& e1, const Vec3& e2, const Vec3& normal, float size,
               const Vec3& wo) {
  const float longest = std::sqrt(std::max({length_squared(e1), length_squared(e2), length_squared(e2 - e1)}));
  const float magnitude = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + longest;
  // The least height is size / longest; a sixth of it at most.
  const float needed = 0x1p-22f * magnitude * longest;
  const float inset = needed * 6 < size ? needed / size : 1 / 6.0f;
  // How the coordinates of the second and third vertex grow on the way back along the ray.
  const float grow_u = dot(cross(wo, e2), normal), grow_v = dot(cross(e1, wo), normal);
  const auto settle = [inset](float coordinate, float growth) {
    return coordinate < inset ? std::copysign(inset, growth) : coordinate;
  };
  const float u = settle(hit.u, grow_u), v = settle(hit.v, grow_v), rest = 1 - u - v;
  const float half = 0.5f * (rest - settle(rest, -grow_u - grow_v));
  return {u + half, v + half};
}

/// Everything of the lobes but the frame.
Bsdf lobes(const Corners& at, bool front) {
  const Material& material = at.material();
  const Rgb base = material.base_color * at.texture(material.base_color_texture).color * at.color().color;
  const Rgb arm = at.texture(material.metallic_roughness_texture).color;
  const float metallic = std::clamp(material.metallic * arm.b, 0.0f, 1.0f);
  const float roughness = std::clamp(material.roughness * arm.g, 0.0f, 1.0f);
  const float dielectric = 1 - metallic;
  const float specular = material.specular * at.texture(material.specular_texture).alpha;
  const Rgb tint = material.specular_color * at.texture(material.specular_color_texture).color;
  const float at_normal = (material.ior - 1) / (material.ior + 1);
  const Rgb f0 = tint * (at_normal * at_normal);
  const float transmission =
      material.transmission > 0 ? material.transmission * at.texture(material.transmission_texture).color.r : 0;

  Bsdf bsdf;
  bsdf.diffuse = base * (dielectric * (1 - transmission));
  bsdf.transmission = base * (dielectric * transmission);
  bsdf.f0 =
      Rgb(std::min(f0.r, 1.0f), std::min(f0.g, 1.0f), std::min(f0.b, 1.0f)) * (specular * dielectric) + base * metallic;
  bsdf.f90 = specular * dielectric + metallic;
  // Only smooth glass is known: where light passes, reflection is smooth too.
  bsdf.alpha = max_component(bsdf.transmission) > 0 ? 0 : roughness * roughness;
  bsdf.solid = material.solid;
  const float ior = material.ior > 0 ? material.ior : 1;  // reflecting alike at all angles, as f0 does by itself
  bsdf.eta = material.solid && !front ? 1 / ior : ior;
  return bsdf;
}

}  // namespace

SurfacePoint surface_point(const Scene& scene, const Ray& ray, const Hit& hit) {
  const Corners at(scene, hit);
  const Mesh& mesh = at.mesh();
  const Material& material = at.material();
  const Vec3 p0 = at.corner(mesh.positions, 0);
  const Vec3 e1 = at.corner(mesh.positions, 1) - p0, e2 = at.corner(mesh.positions, 2) - p0;
  const Vec3 wo = -ray.direction;

  SurfacePoint point;
  point.mesh = hit.mesh;
  point.triangle = hit.triangle;
  const Vec3 across = cross(e1, e2);
  const float size = length(across);
  const Vec3 winding = size > 0 ? across / size : wo;
  const Vec2 at_uv = off_edges(hit, p0, e1, e2, winding, size, wo);
  point.position = p0 + e1 * at_uv.x + e2 * at_uv.y;
  point.offset = ray_offset(point.position, p0, e1, e2);
  point.front = dot(winding, wo) >= 0;
  point.geometric_normal = point.front ? winding : -winding;

  Vec3 authored = winding;
  if (!mesh.normals.empty()) {
    const Vec3 n = at.interpolate(mesh.normals);
    const float n_size = length(n);
    if (n_size > 0) authored = n / n_size;
  }
  const float side = dot(authored, point.geometric_normal) < 0 ? -1.0f : 1.0f;
  point.shading_normal = authored * side;

  point.bsdf = lobes(at, point.front);
  point.bsdf.frame = Frame(facing(mapped_normal(at, authored) * side, wo));
  if (point.front || material.double_sided) point.emission = emission(scene, hit);
  point.attenuation = absorption(material);
  if (!point.front) point.medium = point.attenuation;
  return point;
}

float opacity(const Scene& scene, const Hit& hit) {
  const Corners at(scene, hit);
  const Material& material = at.material();
  if (material.alpha == Alpha::opaque) return 1;
  const float alpha = material.base_alpha * at.texture(material.base_color_texture).alpha * at.color().alpha;
  return material.alpha == Alpha::blend ? alpha : alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
}

Rgb emission(const Scene& scene, const Hit& hit) {
  const Corners at(scene, hit);
  const Material& material = at.material();
  return is_black(material.emission) ? Rgb(0.0f) : material.emission * at.texture(material.emission_texture).color;
}

float ray_offset(const Vec3& position, const Vec3& p, const Vec3& e1, const Vec3& e2, float ray_length) {
  constexpr float rounding = 0x1p-20f;
  const auto sizes = [](const Vec3& v) { return Vec3{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
  const Vec3 across = cross(e1, e2), a = sizes(e1), b = sizes(e2);
  const float size = length(across), longest = max_component(max(a, b));
  float offset = std::max({max_component(sizes(position)), ray_length, longest / 64});  // coordinates can be 0
  if (size > 0) {
    // Each coordinate is rounded, and so are the products that make the normal, which tilts a narrow triangle: by so
    // much that of the narrowest only a part of their height is made up for.
    const Vec3 products{a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
    const float tilt = 0.25f * dot(a + b, products) / size, height = size / longest;
    offset = std::max(offset, dot(sizes(across), sizes(p) + a + b) / size + std::min(tilt, height / (4 * rounding)));
  }
  return rounding * offset;
}

Vec3 offset_origin(const SurfacePoint& point, const Vec3& direction) {
  const float side = dot(direction, point.geometric_normal) >= 0 ? point.offset : -point.offset;
  return point.position + point.geometric_normal * side;
}

}  // namespace isophote
