#include "isophote/scene/emitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "isophote/core/error.h"
#include "isophote/sampling/warp.h"
#include "isophote/scene/environment.h"
#include "isophote/scene/near_grid.h"

namespace isophote {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Triangle {
  Vec3 origin, edge1, edge2;
  Vec3 normal;  // of its winding
  float area = 0;
  std::uint32_t mesh = 0, triangle = 0;
  bool double_sided = false, varies = false;  // varies: emission or opacity, over the triangle
  Rgb radiance;                               // where it does not vary
};

/// Radiance that leaves a hit, what the material lets through taken off.
Rgb covered_emission(const Scene& scene, const Hit& hit) { return emission(scene, hit) * opacity(scene, hit); }

/// How many texels the longest edge of a triangle spans in the textures that make its light vary.
int texel_span(const Scene& scene, const Mesh& mesh, const std::array<std::uint32_t, 3>& ids,
               const Material& material) {
  float longest = 1;
  for (const TextureUse* use : {&material.emission_texture, &material.base_color_texture}) {
    if (use->texture < 0 || mesh.uv[use->uv_set].empty()) continue;
    const auto& uv = mesh.uv[use->uv_set];
    const auto& m = use->matrix;
    const Texture& texture = scene.textures[use->texture];
    for (int i = 0; i < 3; ++i) {
      const Vec2 d = uv[ids[i]] - uv[ids[(i + 1) % 3]];
      const float x = (m[0] * d.x + m[1] * d.y) * static_cast<float>(texture.width);
      const float y = (m[3] * d.x + m[4] * d.y) * static_cast<float>(texture.height);
      longest = std::max(longest, std::sqrt(x * x + y * y));
    }
  }
  constexpr float most = 256;
  return static_cast<int>(std::ceil(std::min(longest, most)));
}

/// Mean luminance of a triangle, at the middles of n^2 equal parts, n enough to see every texel.
double mean_luminance(const Scene& scene, const Triangle& t, int n) {
  double sum = 0;
  const auto at = [&](float i, float j) {
    sum +=
        luminance(covered_emission(scene, {t.mesh, t.triangle, i / static_cast<float>(n), j / static_cast<float>(n)}));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      at(static_cast<float>(i) + 1 / 3.0f, static_cast<float>(j) + 1 / 3.0f);
      if (i + j + 1 < n) at(static_cast<float>(i) + 2 / 3.0f, static_cast<float>(j) + 2 / 3.0f);
    }
  return sum / (static_cast<double>(n) * n);
}

float square(float x) { return x * x; }

double power(const PunctualLight& light, double scene_radius) {
  const double intensity = luminance(light.intensity);
  switch (light.kind) {
    case PunctualLight::Kind::point:
      return 4 * pi * intensity;
    case PunctualLight::Kind::spot:
      return 2 * pi * (1 - std::cos(light.outer_cone)) * intensity;
    case PunctualLight::Kind::directional:
      return pi * scene_radius * scene_radius * intensity;
  }
  return 0;
}

/// The cone's edge, as KHR_lights_punctual recommends it.
float spot_falloff(const PunctualLight& light, const Vec3& towards_light) {
  const float inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
  return square(
      std::clamp((dot(light.direction, -towards_light) - outer) / std::max(0.001f, inner - outer), 0.0f, 1.0f));
}

LightSample sample_punctual(const PunctualLight& light, const Vec3& from) {
  if (light.kind == PunctualLight::Kind::directional)
    return {-light.direction, infinity, light.intensity, 1, true, true};
  const Vec3 offset = light.position - from;
  const float distance = length(offset);
  if (!(distance > 0 && distance < light.range)) return {};
  const Vec3 direction = offset / distance;
  float falloff = light.range == infinity ? 1.0f : 1 - square(square(distance / light.range));
  if (light.kind == PunctualLight::Kind::spot) falloff *= spot_falloff(light, direction);
  return {direction, distance, light.intensity * (falloff / square(distance)), 1, true, true};
}

}  // namespace

struct Emitters::Impl {
  explicit Impl(const Scene& scene_);
  void add_triangles(std::vector<double>& weights);
  void make_tables(std::vector<double> weights);

  // The order of choices: triangles, punctual lights, peaks of the environment, its rest.
  std::size_t first_light() const { return triangles.size(); }
  std::size_t first_peak() const { return first_light() + scene.lights.size(); }
  std::size_t rest() const { return first_peak() + environment.peaks().size(); }
  const AliasTable& table(Among among) const { return among == Among::all ? all : direct; }

  LightSample sample_triangle(const Triangle& t, const Vec3& from, Vec2 u) const;
  LightSample sample_environment(std::size_t index, Vec2 u) const;
  float pdf(const Triangle& t, const Vec3& from, const Vec3& to, const Vec3& direction) const;

  const Scene& scene;
  Environment environment;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> first_of_mesh;  // into emitter_of; none: the mesh does not emit
  std::vector<std::uint32_t> emitter_of;     // triangle of an emissive mesh -> triangles; none: black
  AliasTable all, direct;
  NearGrid near;
};

Emitters::Impl::Impl(const Scene& scene_) : scene(scene_), environment(scene_.environment) {
  const Box bounds = scene.bounds();
  const double radius = bounds.empty() ? 1.0 : 0.5 * bounds.diagonal();
  std::vector<double> weights;
  add_triangles(weights);
  for (const PunctualLight& light : scene.lights) weights.push_back(power(light, radius));
  for (const auto& peak : environment.peaks()) weights.push_back(pi * radius * radius * peak.power);
  weights.push_back(pi * radius * radius * environment.rest_power());
  // The choice is made on a grid of 2^24 numbers, which must leave some to each.
  if (weights.size() > 1u << 20)
    throw UserError("the scene has more than 1048576 emissive triangles, lights and sun-like texels");
  make_tables(std::move(weights));

  std::vector<NearGrid::Place> places;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    Box box;
    for (const Vec3& p : {t.origin, t.origin + t.edge1, t.origin + t.edge2}) box.extend(p);
    // At distance r and both cosines 1, sampling has the density chance r^2 / area, a cosine-distributed ray 1 / pi.
    const float chance = direct.probability(static_cast<std::uint32_t>(i));
    if (chance > 0) places.push_back({box, 0.5f * std::sqrt(t.area / (pi * chance))});
  }
  near = NearGrid(bounds, places);
}

void Emitters::Impl::add_triangles(std::vector<double>& weights) {
  first_of_mesh.assign(scene.meshes.size(), none);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Material& material = scene.materials[mesh.material];
    if (is_black(material.emission)) continue;
    first_of_mesh[m] = static_cast<std::uint32_t>(emitter_of.size());
    const bool varies = material.emission_texture.texture >= 0 || material.alpha != Alpha::opaque;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& ids = mesh.triangles[i];
      Triangle t{mesh.positions[ids[0]],
                 mesh.positions[ids[1]] - mesh.positions[ids[0]],
                 mesh.positions[ids[2]] - mesh.positions[ids[0]],
                 {},
                 0,
                 m,
                 i,
                 material.double_sided,
                 varies,
                 material.emission};
      const Vec3 across = cross(t.edge1, t.edge2);
      const float size = length(across);
      const double mean =
          varies ? mean_luminance(scene, t, texel_span(scene, mesh, ids, material)) : luminance(material.emission);
      const bool emits = size > 0 && mean > 0;
      emitter_of.push_back(emits ? static_cast<std::uint32_t>(triangles.size()) : none);
      if (!emits) continue;
      t.normal = across / size;
      t.area = 0.5f * size;
      triangles.push_back(t);
      weights.push_back(pi * t.area * mean * (t.double_sided ? 2 : 1));
    }
  }
}

void Emitters::Impl::make_tables(std::vector<double> weights) {
  const double rest_weight = weights.back();
  weights.pop_back();
  // Part of the choice goes to all emitters alike: none is so weak beside the others that it could not be chosen.
  constexpr double alike = 0.1;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto emitting =
      static_cast<double>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
  for (double& w : weights)
    if (w > 0) w = (1 - alike) * w + alike * total / emitting;
  direct = AliasTable(weights);
  double sum = 0;
  for (const double w : weights) sum += w;
  weights.push_back(direct.empty() ? rest_weight : std::min(rest_weight, sum));
  all = AliasTable(weights);
}

float Emitters::Impl::pdf(const Triangle& t, const Vec3& from, const Vec3& to, const Vec3& direction) const {
  const float cosine = -dot(t.normal, direction);
  if (cosine == 0 || (cosine < 0 && !t.double_sided)) return 0;
  return length_squared(to - from) / (t.area * std::abs(cosine));
}

LightSample Emitters::Impl::sample_triangle(const Triangle& t, const Vec3& from, Vec2 u) const {
  const Vec2 b = uniform_triangle(u);
  const Vec3 to = t.origin + t.edge1 * b.x + t.edge2 * b.y;
  const float distance = length(to - from);
  if (!(distance > 0)) return {};
  const Vec3 direction = (to - from) / distance;
  const float density = pdf(t, from, to, direction);
  if (!(density > 0)) return {};
  const Rgb radiance = t.varies ? covered_emission(scene, {t.mesh, t.triangle, b.x, b.y}) : t.radiance;
  return {direction, distance, radiance, density, false, true};
}

LightSample Emitters::Impl::sample_environment(std::size_t index, Vec2 u) const {
  const bool peak = index < rest();
  const Vec2 point =
      peak ? environment.sample_peak(static_cast<std::uint32_t>(index - first_peak()), u) : environment.sample_rest(u);
  const float density = peak ? environment.peak_pdf(point) : environment.rest_pdf(point);
  return {environment.direction(point), infinity, environment.radiance(point), density, false, peak};
}

Emitters::Emitters(const Scene& scene) : impl_(std::make_shared<const Impl>(scene)) {}

bool Emitters::empty(Among among) const { return impl_->table(among).empty(); }

LightSample Emitters::sample(const Vec3& from, float u_choice, Vec2 u, Among among) const {
  const AliasTable& table = impl_->table(among);
  const std::uint32_t i = table.sample(u_choice);
  LightSample s = i < impl_->first_light()  ? impl_->sample_triangle(impl_->triangles[i], from, u)
                  : i < impl_->first_peak() ? sample_punctual(impl_->scene.lights[i - impl_->first_light()], from)
                                            : impl_->sample_environment(i, u);
  s.pdf *= table.probability(i);
  return s;
}

float Emitters::triangle_pdf(const Hit& hit, const Vec3& from, const Vec3& direction, Among among) const {
  const std::uint32_t first = impl_->first_of_mesh[hit.mesh];
  if (first == none || impl_->table(among).empty()) return 0;
  const std::uint32_t i = impl_->emitter_of[first + hit.triangle];
  if (i == none) return 0;
  const Triangle& t = impl_->triangles[i];
  return impl_->table(among).probability(i) *
         impl_->pdf(t, from, t.origin + t.edge1 * hit.u + t.edge2 * hit.v, direction);
}

float Emitters::environment_pdf(const Vec3& direction, Among among) const {
  const AliasTable& table = impl_->table(among);
  if (impl_->environment.empty() || table.empty()) return 0;
  const Vec2 point = impl_->environment.point(direction);
  if (const auto peak = impl_->environment.peak_at(point))
    return table.probability(static_cast<std::uint32_t>(impl_->first_peak()) + *peak) *
           impl_->environment.peak_pdf(point);
  if (among == Among::sampled_directly) return 0;
  return table.probability(static_cast<std::uint32_t>(impl_->rest())) * impl_->environment.rest_pdf(point);
}

Emitters::Sky Emitters::environment(const Vec3& direction) const {
  if (impl_->environment.empty()) return {};
  const Vec2 point = impl_->environment.point(direction);
  return {impl_->environment.radiance(point), impl_->environment.peak_at(point).has_value()};
}

bool Emitters::near(const Vec3& from) const { return impl_->near.marked(from); }

}  // namespace isophote
