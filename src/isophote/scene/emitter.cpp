#include "isophote/scene/emitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "isophote/core/error.h"
#include "isophote/scene/emissive_triangles.h"
#include "isophote/scene/environment.h"
#include "isophote/scene/lamp_sampling.h"
#include "isophote/scene/near_grid.h"
#include "isophote/scene/punctual_lights.h"

namespace isophote {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

struct Emitters::Impl {
  explicit Impl(const Scene& scene_);
  void number_triangles();
  void make_tables(std::vector<double> weights);
  void prepare_few(std::span<const double> powers);
  NearGrid grid_of_near(const Box& bounds) const;

  // The order of choices: triangles, peaks of the environment, its rest.
  std::size_t peaks() const { return triangles.size(); }
  std::size_t rest() const { return peaks() + 1; }
  const AliasTable& table(Among among) const { return among == Among::all ? all : direct; }

  LightSample sample_environment(std::size_t index, Vec2 u) const;
  bool few() const { return !mean_radiances.empty(); }
  float few_chance(Among among) const { return among == Among::all ? few_of_all : few_of_direct; }
  LightSample sample_few(const Vec3& from, float u_choice, Vec2 u, Among among) const;
  LightSample sample_many(const Vec3& from, float u_choice, Vec2 u, Among among) const;

  const Scene& scene;
  Environment environment;
  std::vector<EmissiveTriangle> triangles;
  std::vector<std::uint32_t> first_of_mesh;  // into emitter_of; none: the mesh does not emit
  std::vector<std::uint32_t> emitter_of;     // triangle of an emissive mesh -> triangles; none: black
  AliasTable all, direct;
  std::vector<float> mean_radiances;        // luminance, of few triangles; empty: they are many
  float few_of_all = 0, few_of_direct = 0;  // of all of them together
  std::array<PunctualLights, 3> punctual;   // by PunctualKinds
  NearGrid near;
};

Emitters::Impl::Impl(const Scene& scene_)
    : scene(scene_),
      environment(scene_.environment),
      punctual{PunctualLights(scene_, PunctualKinds::all), PunctualLights(scene_, PunctualKinds::directional),
               PunctualLights(scene_, PunctualKinds::placed)} {
  const Box bounds = scene.bounds();
  const double radius = bounds.empty() ? 1.0 : 0.5 * bounds.diagonal();
  auto [emissive, weights] = emissive_triangles(scene);
  triangles = std::move(emissive);
  number_triangles();
  const std::vector<double> powers = weights;
  if (std::max(weights.size(), scene.lights.size()) > most)
    throw UserError("the scene has more than " + std::to_string(most) + " emissive triangles, or as many lights");
  weights.push_back(pi * radius * radius * environment.peak_power());
  weights.push_back(pi * radius * radius * environment.rest_power());
  make_tables(std::move(weights));
  if (triangles.size() <= FewChoice::most) prepare_few(powers);
  near = grid_of_near(bounds);
}

void Emitters::Impl::prepare_few(std::span<const double> powers) {
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const EmissiveTriangle& t = triangles[i];
    mean_radiances.push_back(static_cast<float>(powers[i] / (pi * t.area * (t.double_sided ? 2 : 1))));
    few_of_all += all.probability(i), few_of_direct += direct.probability(i);
  }
}

NearGrid Emitters::Impl::grid_of_near(const Box& bounds) const {
  std::vector<NearGrid::Place> places;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const EmissiveTriangle& t = triangles[i];
    Box box;
    for (const Vec3& p : {t.origin, t.origin + t.edge1, t.origin + t.edge2}) box.extend(p);
    // Sampling has at least the density chance r^2 / area at distance r, a cosine-distributed ray at most 1 / pi.
    const float chance = direct.probability(static_cast<std::uint32_t>(i));
    if (chance > 0) places.push_back({box, 0.5f * std::sqrt(t.area / (pi * chance))});
  }
  return {bounds, places};
}

void Emitters::Impl::number_triangles() {
  first_of_mesh.assign(scene.meshes.size(), none);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const EmissiveTriangle& t = triangles[i];
    std::uint32_t& first = first_of_mesh[t.mesh];
    if (first == none) {
      first = static_cast<std::uint32_t>(emitter_of.size());
      emitter_of.resize(first + scene.meshes[t.mesh].triangles.size(), none);
    }
    emitter_of[first + t.triangle] = i;
  }
}

void Emitters::Impl::make_tables(std::vector<double> weights) {
  const double rest_weight = weights.back();
  weights.pop_back();
  const double sum = share_alike(std::span(weights));
  direct = AliasTable(weights);
  weights.push_back(direct.empty() ? rest_weight : std::min(rest_weight, sum));
  all = AliasTable(weights);
}

LightSample Emitters::Impl::sample_environment(std::size_t index, Vec2 u) const {
  const bool peak = index == peaks();
  const Vec2 point = peak ? environment.sample_peaks(u) : environment.sample_rest(u);
  const float density = peak ? environment.peak_pdf(point) : environment.rest_pdf(point);
  return {environment.direction(point), infinity, environment.radiance(point), density, false, peak};
}

Emitters::Emitters(const Scene& scene) : impl_(std::make_shared<const Impl>(scene)) {}

bool Emitters::empty(Among among) const { return impl_->table(among).empty(); }

LightSample Emitters::Impl::sample_few(const Vec3& from, float u_choice, Vec2 u, Among among) const {
  const float chance = few_chance(among), peak = table(among).probability(static_cast<std::uint32_t>(peaks()));
  if (u_choice >= chance) {  // shares are multiples of 2^-24, as u_choice is: where there are only lamps, chance is 1
    const std::size_t kind = among == Among::sampled_directly || u_choice < chance + peak ? peaks() : rest();
    LightSample s = sample_environment(kind, u);
    s.pdf *= table(among).probability(static_cast<std::uint32_t>(kind));
    return s;
  }
  const FewChoice choice = choose_lamp(triangles, mean_radiances, from);
  if (choice.empty()) return {};
  const std::uint32_t i = choice.sample(u_choice / chance);
  LightSample s = sample_lamp(scene, triangles[i], from, u);
  s.pdf *= chance * choice.chance(i);
  return s;
}

LightSample Emitters::Impl::sample_many(const Vec3& from, float u_choice, Vec2 u, Among among) const {
  const std::uint32_t i = table(among).sample(u_choice);
  LightSample s = i < peaks() ? sample_lamp(scene, triangles[i], from, u) : sample_environment(i, u);
  s.pdf *= table(among).probability(i);
  return s;
}

LightSample Emitters::sample(const Vec3& from, float u_choice, Vec2 u, Among among) const {
  return impl_->few() ? impl_->sample_few(from, u_choice, u, among) : impl_->sample_many(from, u_choice, u, among);
}

const PunctualLights& Emitters::punctual(PunctualKinds kinds) const {
  return impl_->punctual[static_cast<std::size_t>(kinds)];
}

float Emitters::triangle_pdf(const Hit& hit, const Vec3& from, const Vec3& direction, Among among) const {
  const std::uint32_t first = impl_->first_of_mesh[hit.mesh];
  if (first == none || impl_->table(among).empty()) return 0;
  const std::uint32_t i = impl_->emitter_of[first + hit.triangle];
  if (i == none) return 0;
  const EmissiveTriangle& t = impl_->triangles[i];
  const Vec3 to = t.origin + t.edge1 * hit.u + t.edge2 * hit.v;
  if (!impl_->few()) return impl_->table(among).probability(i) * lamp_pdf(t, from, to, direction);
  const FewChoice choice = choose_lamp(impl_->triangles, impl_->mean_radiances, from);
  if (choice.empty()) return 0;
  return impl_->few_chance(among) * choice.chance(i) * lamp_pdf(t, from, to, direction);
}

float Emitters::environment_pdf(const Vec3& direction, Among among) const {
  const AliasTable& table = impl_->table(among);
  if (impl_->environment.empty() || table.empty()) return 0;
  const Vec2 point = impl_->environment.point(direction);
  if (const float peak = impl_->environment.peak_pdf(point); peak > 0)
    return table.probability(static_cast<std::uint32_t>(impl_->peaks())) * peak;
  if (among == Among::sampled_directly) return 0;
  return table.probability(static_cast<std::uint32_t>(impl_->rest())) * impl_->environment.rest_pdf(point);
}

Emitters::Sky Emitters::environment(const Vec3& direction) const {
  if (impl_->environment.empty()) return {};
  const Vec2 point = impl_->environment.point(direction);
  return {impl_->environment.radiance(point), impl_->environment.in_peak(point)};
}

bool Emitters::near(const Vec3& from) const { return impl_->near.marked(from); }

}  // namespace isophote
