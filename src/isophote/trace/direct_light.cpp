#include "isophote/scene/phase.h"
#include "isophote/trace/light_sampling.h"

namespace isophote {
namespace {

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
  if (world.media && !is_black(arrival.lamp))
    arrival.lamp *= world.media->transmittance({ray.origin, ray.direction, 0, arrival.hit.distance}, seed);
  return arrival;
}

}  // namespace

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
             mis_weight(sample.pdf, light_pdf(world, point.position, sample.direction, arrival, among));
  };
  if (diffuse) add_ray(sample_diffuse(bsdf, albedo, u_ray));
  if (glossy) add_ray(sample_glossy(bsdf, wo, sampler.next2()));
  return sum;
}

Rgb direct_light(const World& world, const MediumPoint& point, const Vec3& direction, Sampler& sampler,
                 RayCounts& counts, Gradient<Rgb>* slope) {
  const float u_choice = sampler.next();
  const Vec2 u_light = sampler.next2();
  const std::uint32_t seed = sampler.next_bits();
  Rgb sum;
  float phase = 0;
  const auto scatter_it = [&](const Incident& light) {
    phase = henyey_greenstein(point.g, dot(direction, light.direction));
    return phase > 0;
  };
  const auto add = [&](const Incident& light) {
    const Rgb scattered = light.radiance * phase;
    sum += scattered;
    if (slope) isophote::add(*slope, henyey_greenstein_turn(point.g, direction, light.direction), scattered);
  };
  sample_lights(world, point, u_choice, u_light, seed, Emitters::Among::sampled_directly, counts, scatter_it, add);
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
                  mis_weight(sample.pdf, light_pdf(world, point.position, sample.direction, arrival, among));
  out.next = arrival.first;
  out.next.emission += arrival.sky;
  return out;
}

}  // namespace isophote
