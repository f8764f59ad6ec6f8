#include "isophote/scene/punctual_lights.h"

#include <algorithm>
#include <cmath>

#include "isophote/sampling/few_choice.h"

namespace isophote {
namespace {

constexpr std::size_t few = 4;

float square(float x) { return x * x; }

double power(const PunctualLight& light, double scene_radius) {
  const double intensity = luminance(Rgbd(light.intensity));
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

bool is_of(PunctualKinds kinds, const PunctualLight& light) {
  const bool directional = light.kind == PunctualLight::Kind::directional;
  return kinds == PunctualKinds::all || directional == (kinds == PunctualKinds::directional);
}

/// The cone's edge, as KHR_lights_punctual recommends it.
float spot_falloff(const PunctualLight& light, const Vec3& towards_light) {
  const float inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
  return square(
      std::clamp((dot(light.direction, -towards_light) - outer) / std::max(0.001f, inner - outer), 0.0f, 1.0f));
}

}  // namespace

LightSample punctual_light_at(const PunctualLight& light, const Vec3& from) {
  if (light.kind == PunctualLight::Kind::directional)
    return {-light.direction, infinity, light.intensity, 1, true, true};
  const Vec3 offset = light.position - from;
  const float distance = length(offset);
  if (!(distance > 0 && distance < light.range)) return {};
  const Vec3 direction = offset / distance;
  float falloff = light.range == infinity ? 1.0f : 1 - square(square(distance / light.range));
  if (light.kind == PunctualLight::Kind::spot) falloff *= spot_falloff(light, direction);
  return {direction, distance, light.intensity * (falloff / square(distance)), 1, true, true, light.position};
}

PunctualLights::PunctualLights(const Scene& scene, PunctualKinds kinds) {
  const Box bounds = scene.bounds();
  const double radius = bounds.empty() ? 1.0 : 0.5 * bounds.diagonal();
  std::vector<double> powers;
  for (const PunctualLight& light : scene.lights) {
    if (!is_of(kinds, light)) continue;
    lights_.push_back(&light);
    powers.push_back(power(light, radius));
  }
  share_alike(std::span(powers));
  by_power_ = AliasTable(powers);
}

int PunctualLights::samples() const {
  if (by_power_.empty()) return 0;
  return lights_.size() <= few ? static_cast<int>(lights_.size()) : 1;
}

LightSample PunctualLights::sample(int i, const Vec3& from, float u) const {
  if (lights_.size() <= few) return punctual_light_at(*lights_[static_cast<std::size_t>(i)], from);
  if (lights_.size() <= FewChoice::most) return sample_by_irradiance(from, u);
  const std::uint32_t chosen = by_power_.sample(u);
  LightSample sample = punctual_light_at(*lights_[chosen], from);
  sample.pdf *= by_power_.probability(chosen);
  return sample;
}

PunctualLights::Chosen PunctualLights::choose(int i, float u) const {
  if (lights_.size() <= few) return {lights_[static_cast<std::size_t>(i)], 1};
  const std::uint32_t chosen = by_power_.sample(u);
  return {lights_[chosen], by_power_.probability(chosen)};
}

LightSample PunctualLights::sample_by_irradiance(const Vec3& from, float u) const {
  const FewChoice choice(lights_.size(),
                         [&](std::uint32_t i) { return max_component(punctual_light_at(*lights_[i], from).radiance); });
  if (choice.empty()) return {};  // infinite on the very place of a light
  const std::uint32_t chosen = choice.sample(u);
  LightSample sample = punctual_light_at(*lights_[chosen], from);
  sample.pdf *= choice.chance(chosen);
  return sample;
}

}  // namespace isophote
