#include "isophote/trace/placed_lights.h"

#include <algorithm>
#include <cmath>

#include "isophote/scene/phase.h"
#include "isophote/scene/punctual_lights.h"
#include "isophote/trace/shadow.h"

namespace isophote {
namespace {

/// A place on a ray, and what stands for the length around it: over the density of its choice.
struct RayPlace {
  float distance = 0, length = 0;  ///< length 0: there is none
};

/// By the angle at the light, uniformly, where the light shines.
RayPlace place_by_angle(const Ray& ray, const PunctualLight& light, float u) {
  const Vec3 to_light = light.position - ray.origin;
  const float middle = dot(to_light, ray.direction);
  const Vec3 across = ray.direction * middle - to_light;  // from the light to the nearest point of the line
  const float height = length(across);
  if (!(height > 0)) return {};
  float first = std::atan2(ray.near - middle, height), last = std::atan2(ray.far - middle, height);
  if (light.kind == PunctualLight::Kind::spot) {
    // A direction at the angle t from `across` towards the ray's makes with the axis the cosine size cos(t - turn).
    const float a = dot(light.direction, across) / height, b = dot(light.direction, ray.direction);
    const float size = std::hypot(a, b), turn = std::atan2(b, a), cosine = std::cos(light.outer_cone);
    if (!(cosine < size)) return {};
    const float half = std::acos(std::max(cosine / size, -1.0f));
    first = std::max(first, turn - half), last = std::min(last, turn + half);
  }
  if (!(first < last)) return {};
  const float along = height * std::tan(first + u * (last - first)), distance = middle + along;
  if (!(ray.near < distance && distance < ray.far)) return {};  // by rounding
  return {distance, (last - first) * (height + along * along / height)};
}

/// What of light passes from a place to the ray's origin, and its logarithm's gradient where that is asked.
Media::Passage passage_from(const World& world, const Ray& ray, float distance, bool with_gradient, Sampler& sampler) {
  const Ray way{ray.origin, ray.direction, 0, distance};
  Media::Passage passage;
  if (with_gradient)
    world.media->along(way, {&distance, 1}, {&passage, 1});
  else
    passage.transmittance = world.media->transmittance(way, sampler.next_bits());
  return passage;
}

/// Light that comes of one light from a place, over the chance of both.
Rgb light_at(const World& world, const PunctualLights::Chosen& chosen, const Ray& ray, const RayPlace& place,
             const Rgb& inside, Sampler& sampler, RayCounts& counts, LightChange* change) {
  const auto scatterer = world.media->scatterer(ray.origin + ray.direction * place.distance, sampler.next());
  if (!scatterer) return {};
  MediumPoint point = scatterer->point;
  point.inside = inside;
  const LightSample sample = punctual_light_at(*chosen.light, point.position);
  if (is_black(sample.radiance)) return {};
  const float phase = henyey_greenstein(point.g, dot(ray.direction, sample.direction));
  Rgb light = scatterer->scattering * sample.radiance * (place.length * phase / chosen.chance);
  const Media::Passage passage = passage_from(world, ray, place.distance, change != nullptr, sampler);
  light *= transmittance(inside, place.distance) * passage.transmittance;
  if (is_black(light)) return {};
  light *= light_transmittance(world, ShadowStart(point, sample.direction), sample, sampler.next_bits(), counts);
  if (change) {
    add(change->turn, henyey_greenstein_turn(point.g, ray.direction, sample.direction), light);
    add(change->passage, passage.log_gradient, light);
  }
  return light;
}

}  // namespace

Rgb placed_lights_along(const World& world, const Ray& ray, const Rgb& inside, Sampler& sampler, RayCounts& counts,
                        LightChange* change) {
  Rgb sum;
  const PunctualLights& lights = world.emitters.punctual(PunctualKinds::placed);
  if (lights.samples() == 0) return sum;
  const Ray within = world.media->within(ray);
  if (!(within.near < within.far)) return sum;
  for (int i = 0; i < lights.samples(); ++i) {
    const PunctualLights::Chosen chosen = lights.choose(i, sampler.next());
    const float u = sampler.next();
    const RayPlace place = place_by_angle(within, *chosen.light, u);
    if (place.length > 0) sum += light_at(world, chosen, ray, place, inside, sampler, counts, change);
  }
  return sum;
}

}  // namespace isophote
