#pragma once

#include "isophote/sampling/warp.h"
#include "isophote/scene/punctual_lights.h"
#include "isophote/trace/arrival.h"
#include "isophote/trace/shadow.h"

namespace isophote {

/// The power heuristic (exponent 2) [Veach 1997]: weight of the technique of density `mine`.
inline float mis_weight(float mine, float other) {
  const float ratio = other / mine;
  return 1 / (1 + ratio * ratio);
}

/// Incident light leaks where the mapped and the geometric normal disagree about its side: such directions scatter
/// nothing.
inline bool scatters_from(const SurfacePoint& point, const Vec3& wi) {
  return dot(wi, point.bsdf.frame.n) > 0 && dot(wi, point.geometric_normal) > 0;
}
inline bool scatters_from(const MediumPoint&, const Vec3&) { return true; }

/// Point and spot lights are no matter of points in media: placed_lights.h.
inline PunctualKinds punctual_kinds(const SurfacePoint&) { return PunctualKinds::all; }
inline PunctualKinds punctual_kinds(const MediumPoint&) { return PunctualKinds::directional; }

/// One light sample at a point: what it sends there, over its density.
struct Incident {
  Vec3 direction;
  Rgb radiance;
  float pdf = 0;  ///< to be weighed against a BSDF ray's; 0: none can find this light
  bool sampled_directly = true;
};

/// Calls add(incident) for what one sample of lamps and environment and those of the punctual lights bring. `scatters`
/// of the incident light, nothing in its way, decides whether a shadow ray is worth it.
template <class Point, class Scatters, class Add>
void sample_lights(const World& world, const Point& point, float u_choice, Vec2 u, std::uint32_t seed,
                   Emitters::Among among, RayCounts& counts, const Scatters& scatters, const Add& add) {
  const auto take = [&](const LightSample& light) {
    if (!(light.pdf > 0) || is_black(light.radiance) || !scatters_from(point, light.direction)) return;
    Incident incident{light.direction, light.radiance / light.pdf, light.delta ? 0.0f : light.pdf,
                      light.sampled_directly};
    if (!scatters(incident)) return;
    incident.radiance *= light_transmittance(world, ShadowStart(point, light.direction), light, seed, counts);
    if (!is_black(incident.radiance)) add(incident);
  };
  const Emitters& emitters = world.emitters;
  if (!emitters.empty(among)) take(emitters.sample(point.position, u_choice, u, among));
  const PunctualLights& punctual = emitters.punctual(punctual_kinds(point));
  for (int i = 0; i < punctual.samples(); ++i) take(punctual.sample(i, point.position, u_choice));
}

/// The density with which light sampling would have taken the direction of a ray that brought `arrival`.
inline float light_pdf(const World& world, const Vec3& from, const Vec3& direction, const Arrival& arrival,
                       Emitters::Among among) {
  if (arrival.hit.distance == infinity) return world.emitters.environment_pdf(direction, among);
  return world.emitters.triangle_pdf(arrival.hit, from, direction, among);
}

inline BsdfSample sample_diffuse(const Bsdf& bsdf, const Rgb& albedo, Vec2 u) {
  const Vec3 local = cosine_hemisphere(u);
  return {bsdf.frame.to_world(local), albedo, cosine_hemisphere_pdf(local.z), false};
}

inline bool usable(const SurfacePoint& point, const BsdfSample& sample) {
  return sample.pdf > 0 && !is_black(sample.weight) && scatters_from(point, sample.direction);
}

}  // namespace isophote
