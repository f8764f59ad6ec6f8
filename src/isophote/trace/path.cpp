#include "isophote/trace/path.h"

#include <algorithm>

#include "isophote/scene/phase.h"
#include "isophote/trace/light_sampling.h"

namespace isophote {
namespace {

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

/// Light that the event's ray, chosen with density `pdf`, met at the end of its first segment: shared with light
/// sampling by MIS.
void take_light_met(const World& world, const Vec3& from, const Vec3& direction, float pdf, Event& event) {
  const Arrival& next = event.next;
  if (is_black(next.lamp) && is_black(next.sky)) return;
  const float mis = mis_weight(pdf, light_pdf(world, from, direction, next, Emitters::Among::all));
  event.direct += event.weight * next.lamp * mis;
  event.rest += event.weight * next.sky * mis;
  event.rest_irradiance += next.sky * (event.irradiance_weight * mis);
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
  take_light_met(world, point.position, sample.direction, chance * sample.pdf, event);
  return event;
}

/// The same in a medium, which scatters a ray of `direction`.
Event scatter_once(const World& world, const MediumPoint& point, const Vec3& direction, int depth, Sampler& sampler,
                   RayCounts& counts) {
  Event event;
  if (depth >= world.max_depth) return event;
  const float u_choice = sampler.next();
  const Vec2 u_light = sampler.next2(), u_ray = sampler.next2();
  float scattered = 0;
  const auto scatter_it = [&](const Incident& light) {
    const float phase = henyey_greenstein(point.g, dot(direction, light.direction));
    scattered = phase * (light.pdf > 0 ? mis_weight(light.pdf, phase) : 1.0f);
    return scattered > 0;
  };
  const auto add = [&](const Incident& light) {
    (light.sampled_directly ? event.direct : event.rest) += light.radiance * scattered;
  };
  sample_lights(world, point, u_choice, u_light, sampler.next_bits(), Emitters::Among::all, counts, scatter_it, add);

  const Vec3 next = sample_henyey_greenstein(point.g, direction, u_ray);
  event.next = follow(world, {point.position, next}, point.inside, depth + 1, sampler, counts.path);
  event.weight = Rgb(1.0f);
  take_light_met(world, point.position, next, henyey_greenstein(point.g, dot(direction, next)), event);
  return event;
}

Event scatter_once(const World& world, const FirstPoint& at, int depth, Sampler& sampler, RayCounts& counts) {
  return at.point ? scatter_once(world, *at.point, -at.direction, depth, sampler, counts)
                  : scatter_once(world, *at.medium_point, at.direction, depth, sampler, counts);
}

/// Radiance that `arrival` brings but for what its first segment met: light after specular events, and a path from its
/// point.
Rgb trace_on(const World& world, Arrival arrival, int depth, Sampler& sampler, RayCounts& counts) {
  constexpr int sure_events = 3;
  Rgb radiance = arrival.first.emission, throughput = arrival.first.throughput;
  for (int events = 1; arrival.first.scatters() && !is_black(throughput); ++events) {
    depth += arrival.first.depth;
    if (events > sure_events) {
      const float chance = std::min(0.95f, max_component(throughput));
      if (!(sampler.next() < chance)) break;
      throughput = throughput / chance;
    }
    Event event = scatter_once(world, arrival.first, depth++, sampler, counts);
    radiance += throughput * (event.direct + event.rest + event.weight * event.next.first.emission);
    throughput *= event.weight * event.next.first.throughput;
    arrival = std::move(event.next);
  }
  return radiance;
}

/// An event with all that its ray brings.
Scattered follow_up(const World& world, const Event& event, int depth, Sampler& sampler, RayCounts& counts) {
  Scattered out{event.direct, event.rest, event.rest_irradiance};
  if (is_black(event.weight)) return out;
  const Rgb incoming = trace_on(world, event.next, depth + 1, sampler, counts);
  out.indirect += event.weight * incoming;
  out.irradiance += incoming * event.irradiance_weight;
  return out;
}

}  // namespace

RayCounts& RayCounts::operator+=(const RayCounts& o) {
  camera += o.camera, path += o.path, shadow += o.shadow, gather += o.gather, check += o.check;
  verification += o.verification;
  return *this;
}

Scattered scatter(const World& world, const SurfacePoint& point, const Vec3& wo, int depth, Sampler& sampler,
                  RayCounts& counts) {
  return follow_up(world, scatter_once(world, point, wo, depth, sampler, counts), depth, sampler, counts);
}

Scattered scatter(const World& world, const MediumPoint& point, const Vec3& direction, int depth, Sampler& sampler,
                  RayCounts& counts) {
  return follow_up(world, scatter_once(world, point, direction, depth, sampler, counts), depth, sampler, counts);
}

Rgb path_radiance(const World& world, const FirstPoint& first, int depth, Sampler& sampler, RayCounts& counts) {
  const Scattered s = follow_up(world, scatter_once(world, first, depth, sampler, counts), depth, sampler, counts);
  return s.direct + s.indirect;
}

}  // namespace isophote
