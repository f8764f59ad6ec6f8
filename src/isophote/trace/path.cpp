#include "isophote/trace/path.h"

#include <algorithm>

#include "isophote/sampling/warp.h"
#include "isophote/trace/arrival.h"
#include "isophote/trace/shadow.h"

namespace isophote {
namespace {

/// The power heuristic (exponent 2) [Veach 1997]: weight of the technique of density `mine`.
float mis_weight(float mine, float other) {
  const float ratio = other / mine;
  return 1 / (1 + ratio * ratio);
}

/// The lobes that `follow` leaves to a point: diffuse and glossy, and the chances with which one is chosen.
struct Lobes {
  Rgb diffuse_albedo;
  float diffuse = 0, glossy = 0;

  Lobes(const Bsdf& bsdf, const Vec3& wo) {
    const LobeChances chances = lobe_chances(bsdf, wo);
    const float sum = chances.diffuse + chances.glossy;
    if (!(sum > 0)) return;
    diffuse = chances.diffuse / sum, glossy = chances.glossy / sum;
    diffuse_albedo = isophote::diffuse_albedo(bsdf, wo);
  }
  bool black() const { return !(diffuse + glossy > 0); }
};

/// Incident light leaks where the mapped and the geometric normal disagree about its side: such directions scatter
/// nothing.
bool scatters_from(const SurfacePoint& point, const Vec3& wi) {
  return dot(wi, point.bsdf.frame.n) > 0 && dot(wi, point.geometric_normal) > 0;
}

/// One light sample at a point: what it sends there, over its density.
struct Incident {
  Vec3 direction;
  Rgb radiance;
  float pdf = 0;  ///< to be weighed against a BSDF ray's; 0: none can find this light
  bool sampled_directly = true;
};

/// Calls add(incident) for what one sample of lamps and environment and those of the punctual lights bring. `scatters`
/// of the incident light, nothing in its way, decides whether a shadow ray is worth it.
template <class Scatters, class Add>
void sample_lights(const World& world, const SurfacePoint& point, float u_choice, Vec2 u, std::uint32_t seed,
                   Emitters::Among among, RayCounts& counts, const Scatters& scatters, const Add& add) {
  const auto take = [&](const LightSample& light) {
    if (!(light.pdf > 0) || is_black(light.radiance) || !scatters_from(point, light.direction)) return;
    Incident incident{light.direction, light.radiance / light.pdf, light.delta ? 0.0f : light.pdf,
                      light.sampled_directly};
    if (!scatters(incident)) return;
    incident.radiance *= light_transmittance(world, point, light, seed, counts);
    if (!is_black(incident.radiance)) add(incident);
  };
  const Emitters& emitters = world.emitters;
  if (!emitters.empty(among)) take(emitters.sample(point.position, u_choice, u, among));
  for (int i = 0; i < emitters.punctual_samples(); ++i) take(emitters.sample_punctual(i, point.position, u_choice));
}

/// The density with which light sampling would have taken the direction of a ray that brought `arrival`.
float light_pdf(const World& world, const SurfacePoint& from, const Vec3& direction, const Arrival& arrival,
                Emitters::Among among) {
  if (arrival.hit.distance == infinity) return world.emitters.environment_pdf(direction, among);
  return world.emitters.triangle_pdf(arrival.hit, from.position, direction, among);
}

BsdfSample sample_diffuse(const Bsdf& bsdf, const Rgb& albedo, Vec2 u) {
  const Vec3 local = cosine_hemisphere(u);
  return {bsdf.frame.to_world(local), albedo, cosine_hemisphere_pdf(local.z), false};
}

bool usable(const SurfacePoint& point, const BsdfSample& sample) {
  return sample.pdf > 0 && !is_black(sample.weight) && scatters_from(point, sample.direction);
}

/// One scattering event of a path: light sampled here, and the ray by which more is gathered.
struct Event {
  Rgb direct, rest;             ///< scattered here: light of directly sampled emitters, of the environment's rest
  Rgb rest_irradiance;          ///< of the latter on the diffuse lobe's hemisphere
  Rgb weight;                   ///< of what `next` brings; black: there is no ray
  float irradiance_weight = 0;  ///< the same for irradiance: pi over the chance where the diffuse lobe was chosen
  Arrival next;
};

/// Light sampling for both lobes. Each lobe by itself is shared by MIS with its ray, whose density is chance * pdf.
void add_light(const World& world, const SurfacePoint& point, const Vec3& wo, const Lobes& lobes, float u_choice,
               Vec2 u, std::uint32_t seed, RayCounts& counts, Event& event) {
  const Bsdf& bsdf = point.bsdf;
  Rgb scattered;
  float irradiance = 0;
  const auto scatter_it = [&](const Incident& light) {
    scattered = {}, irradiance = 0;
    const float cosine = dot(light.direction, bsdf.frame.n);
    if (lobes.diffuse > 0) {
      const float weight = light.pdf > 0 ? mis_weight(light.pdf, lobes.diffuse * cosine_hemisphere_pdf(cosine)) : 1.0f;
      irradiance = cosine * weight;
      scattered = lobes.diffuse_albedo * (irradiance / pi);
    }
    if (lobes.glossy > 0) {
      const float weight =
          light.pdf > 0 ? mis_weight(light.pdf, lobes.glossy * glossy_pdf(bsdf, wo, light.direction)) : 1.0f;
      scattered += evaluate_glossy(bsdf, wo, light.direction) * weight;
    }
    return !is_black(scattered);
  };
  const auto add = [&](const Incident& light) {
    (light.sampled_directly ? event.direct : event.rest) += scattered * light.radiance;
    if (!light.sampled_directly) event.rest_irradiance += light.radiance * irradiance;
  };
  sample_lights(world, point, u_choice, u, seed, Emitters::Among::all, counts, scatter_it, add);
}

Event scatter_once(const World& world, const SurfacePoint& point, const Vec3& wo, int depth, Sampler& sampler,
                   RayCounts& counts) {
  Event event;
  const Lobes lobes(point.bsdf, wo);
  if (lobes.black() || depth >= world.max_depth) return event;
  const Vec2 choice = sampler.next2(), u_light = sampler.next2(), u_ray = sampler.next2();
  add_light(world, point, wo, lobes, choice.x, u_light, sampler.next_bits(), counts, event);

  const bool diffuse = choice.y < lobes.diffuse;
  const float chance = diffuse ? lobes.diffuse : lobes.glossy;
  const BsdfSample sample =
      diffuse ? sample_diffuse(point.bsdf, lobes.diffuse_albedo, u_ray) : sample_glossy(point.bsdf, wo, u_ray);
  if (!usable(point, sample)) return event;
  const Ray ray{offset_origin(point, sample.direction), sample.direction};
  event.next = follow(world, ray, point.medium, depth + 1, sampler, counts.path);
  event.weight = sample.weight / chance;
  event.irradiance_weight = diffuse ? pi / chance : 0.0f;
  const Arrival& next = event.next;
  if (is_black(next.lamp) && is_black(next.sky)) return event;
  const float mis =
      mis_weight(chance * sample.pdf, light_pdf(world, point, sample.direction, next, Emitters::Among::all));
  event.direct += event.weight * next.lamp * mis;
  event.rest += event.weight * next.sky * mis;
  event.rest_irradiance += next.sky * (event.irradiance_weight * mis);
  return event;
}

/// The directly sampled emitter that a ray meets first, if it does: `arrival.lamp`.
Arrival lamp_along(const World& world, const SurfacePoint& point, const Vec3& direction, std::uint32_t seed,
                   RayCounts& counts) {
  const Ray ray{offset_origin(point, direction), direction};
  Arrival arrival;
  ++counts.path;
  if (world.rays.intersect(ray, seed, arrival.hit)) {
    const SurfacePoint end = surface_point(world.scene, ray, arrival.hit);
    arrival.lamp = end.emission * transmittance(medium_before(end, point.medium), arrival.hit.distance);
  } else if (const Emitters::Sky sky = world.emitters.environment(direction); sky.sampled_directly) {
    arrival.lamp = sky.radiance;
  }
  return arrival;
}

/// Radiance that `arrival` brings but for what its first segment met: light after specular events, and a path from its
/// point.
Rgb trace_on(const World& world, Arrival arrival, int depth, Sampler& sampler, RayCounts& counts) {
  constexpr int sure_events = 3;
  Rgb radiance = arrival.first.emission, throughput = arrival.first.throughput;
  for (int events = 1; arrival.first.point && !is_black(throughput); ++events) {
    depth += arrival.first.depth;
    if (events > sure_events) {
      const float chance = std::min(0.95f, max_component(throughput));
      if (!(sampler.next() < chance)) break;
      throughput = throughput / chance;
    }
    Event event = scatter_once(world, *arrival.first.point, -arrival.first.direction, depth++, sampler, counts);
    radiance += throughput * (event.direct + event.rest + event.weight * event.next.first.emission);
    throughput *= event.weight * event.next.first.throughput;
    arrival = std::move(event.next);
  }
  return radiance;
}

}  // namespace

RayCounts& RayCounts::operator+=(const RayCounts& o) {
  camera += o.camera, path += o.path, shadow += o.shadow, gather += o.gather, check += o.check;
  verification += o.verification;
  return *this;
}

Scattered scatter(const World& world, const SurfacePoint& point, const Vec3& wo, int depth, Sampler& sampler,
                  RayCounts& counts) {
  const Event event = scatter_once(world, point, wo, depth, sampler, counts);
  Scattered out{event.direct, event.rest, event.rest_irradiance};
  if (is_black(event.weight)) return out;
  const Rgb incoming = trace_on(world, event.next, depth + 1, sampler, counts);
  out.indirect += event.weight * incoming;
  out.irradiance += incoming * event.irradiance_weight;
  return out;
}

Rgb direct_light(const World& world, const SurfacePoint& point, const Vec3& wo, bool glossy_too, Sampler& sampler,
                 RayCounts& counts) {
  constexpr auto among = Emitters::Among::sampled_directly;
  const float u_choice = sampler.next();
  const Vec2 u_light = sampler.next2(), u_ray = sampler.next2();
  const std::uint32_t seed = sampler.next_bits();
  const Bsdf& bsdf = point.bsdf;
  const Rgb albedo = diffuse_albedo(bsdf, wo);
  const bool diffuse = !is_black(albedo), glossy = glossy_too && bsdf.has_glossy();
  if (!(diffuse || glossy) || world.max_depth < 1) return {};
  const bool shared = world.emitters.near(point.position);

  Rgb sum, scattered;
  const auto scatter_it = [&](const Incident& light) {
    scattered = {};
    const bool weigh = shared && light.pdf > 0;
    if (diffuse) {
      const float c = dot(light.direction, bsdf.frame.n);
      scattered = albedo * (c / pi * (weigh ? mis_weight(light.pdf, cosine_hemisphere_pdf(c)) : 1.0f));
    }
    if (glossy)
      scattered += evaluate_glossy(bsdf, wo, light.direction) *
                   (weigh ? mis_weight(light.pdf, glossy_pdf(bsdf, wo, light.direction)) : 1.0f);
    return !is_black(scattered);
  };
  const auto add = [&](const Incident& light) { sum += scattered * light.radiance; };
  sample_lights(world, point, u_choice, u_light, seed, among, counts, scatter_it, add);
  if (!shared) return sum;
  const auto add_ray = [&](const BsdfSample& sample) {
    if (!usable(point, sample)) return;
    const Arrival arrival = lamp_along(world, point, sample.direction, seed, counts);
    if (!is_black(arrival.lamp))
      sum += sample.weight * arrival.lamp *
             mis_weight(sample.pdf, light_pdf(world, point, sample.direction, arrival, among));
  };
  if (diffuse) add_ray(sample_diffuse(bsdf, albedo, u_ray));
  if (glossy) add_ray(sample_glossy(bsdf, wo, sampler.next2()));
  return sum;
}

GlossyRay glossy_ray(const World& world, const SurfacePoint& point, const Vec3& wo, Sampler& sampler,
                     RayCounts& counts) {
  constexpr auto among = Emitters::Among::sampled_directly;
  GlossyRay out;
  const float u_choice = sampler.next();
  const Vec2 u_light = sampler.next2(), u_ray = sampler.next2();
  if (!point.bsdf.has_glossy()) return out;

  Rgb scattered;
  const auto scatter_it = [&](const Incident& light) {
    scattered = evaluate_glossy(point.bsdf, wo, light.direction);
    if (light.pdf > 0) scattered *= mis_weight(light.pdf, glossy_pdf(point.bsdf, wo, light.direction));
    return !is_black(scattered);
  };
  const auto add = [&](const Incident& light) { out.direct += scattered * light.radiance; };
  sample_lights(world, point, u_choice, u_light, sampler.next_bits(), among, counts, scatter_it, add);

  const BsdfSample sample = sample_glossy(point.bsdf, wo, u_ray);
  if (!usable(point, sample)) return out;
  const Ray ray{offset_origin(point, sample.direction), sample.direction};
  Arrival arrival = follow(world, ray, point.medium, 1, sampler, counts.path);
  out.weight = sample.weight;
  if (!is_black(arrival.lamp))
    out.direct += sample.weight * arrival.lamp *
                  mis_weight(sample.pdf, light_pdf(world, point, sample.direction, arrival, among));
  out.next = arrival.first;
  out.next.emission += arrival.sky;
  return out;
}

}  // namespace isophote
