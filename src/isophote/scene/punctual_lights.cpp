#include "isophote/scene/punctual_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace isophote {
namespace {

constexpr std::size_t few = 32;

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

/// The cone's edge, as KHR_lights_punctual recommends it.
float spot_falloff(const PunctualLight& light, const Vec3& towards_light) {
  const float inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
  return square(
      std::clamp((dot(light.direction, -towards_light) - outer) / std::max(0.001f, inner - outer), 0.0f, 1.0f));
}

LightSample sample_one(const PunctualLight& light, const Vec3& from) {
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

}  // namespace

PunctualLights::PunctualLights(const Scene& scene) : lights_(scene.lights) {
  const Box bounds = scene.bounds();
  const double radius = bounds.empty() ? 1.0 : 0.5 * bounds.diagonal();
  std::vector<double> powers;
  for (const PunctualLight& light : lights_) powers.push_back(power(light, radius));
  // A tenth of the choice goes to all alike: none is so weak beside the others that it could not be chosen.
  const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) / static_cast<double>(powers.size());
  for (double& p : powers)
    if (p > 0) p = 0.9 * p + 0.1 * mean;
  by_power_ = AliasTable(powers);
}

LightSample PunctualLights::sample(const Vec3& from, float u) const {
  if (lights_.size() > few) {
    const std::uint32_t i = by_power_.sample(u);
    LightSample chosen = sample_one(lights_[i], from);
    chosen.pdf *= by_power_.probability(i);
    return chosen;
  }
  std::array<float, few> sums;
  float sum = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    sums[i] = sum += max_component(sample_one(lights_[i], from).radiance);
  if (!(sum > 0 && sum < infinity)) return {};  // infinite on the very place of a light
  const auto end = sums.begin() + static_cast<std::ptrdiff_t>(lights_.size());
  const auto found = std::min(std::upper_bound(sums.begin(), end, u * sum), end - 1);
  const float below = found == sums.begin() ? 0 : *(found - 1);
  LightSample chosen = sample_one(lights_[static_cast<std::size_t>(found - sums.begin())], from);
  chosen.pdf *= (*found - below) / sum;
  return chosen;
}

}  // namespace isophote
