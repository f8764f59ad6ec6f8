#include "isophote/trace/arrival.h"

#include <algorithm>

#include "isophote/trace/placed_lights.h"
#include "isophote/trace/shadow.h"

namespace isophote {
namespace {

/// Ends long specular chains without bias. False: the path ends here.
bool survives(Rgb& throughput, int events, Sampler& sampler) {
  constexpr int sure_events = 8;
  if (events < sure_events) return true;
  const float chance = std::min(0.95f, max_component(throughput));
  if (!(sampler.next() < chance)) return false;
  throughput = throughput / chance;
  return true;
}

/// Lets media act on a ray up to its end, before which `depth` events happened; true where one scatters it: the ray
/// goes no further.
bool scattered_on_the_way(const World& world, const Ray& ray, const Rgb& inside, int depth, Sampler& sampler,
                          std::uint64_t& kind, FirstPoint& first) {
  if (depth < world.max_depth) {
    RayCounts shadows;
    first.emission += first.throughput * placed_lights_along(world, ray, inside, sampler, shadows);
    kind += shadows.total();
  }
  first.medium_point = world.media->collide(ray, sampler, first.throughput, first.emission);
  if (!first.medium_point) return false;
  const float way = length(first.medium_point->position - ray.origin);
  first.medium_point->inside = inside;
  first.throughput *= transmittance(inside, way);
  first.path_length += way;
  return true;
}

}  // namespace

const Rgb& medium_before(const SurfacePoint& point, const Rgb& inside) {
  return is_black(point.medium) ? inside : point.medium;
}

Arrival follow(const World& world, const Ray& start, Rgb inside, int depth, Sampler& sampler, std::uint64_t& kind,
               FirstSegment first_segment) {
  Arrival arrival;
  FirstPoint& first = arrival.first;
  Ray ray = start;
  for (;;) {
    ++kind;
    first.direction = ray.direction;
    const bool straight = first.depth == 0;  // no specular event yet
    Hit hit;
    SurfacePoint point;
    const bool met = world.rays.intersect(ray, sampler.next_bits(), hit);
    if (met) point = surface_point(world.scene, ray, hit);
    if (met && straight) {
      arrival.hit = hit;
      first.first_distance = hit.distance;
      first.first_normal = point.geometric_normal;
      first.first_mesh = hit.mesh;
    }
    const bool in_media = world.media && !(straight && first_segment == FirstSegment::clear);
    if (in_media && scattered_on_the_way(world, {ray.origin, ray.direction, 0, hit.distance}, inside,
                                         depth + first.depth, sampler, kind, first))
      return arrival;
    if (!met) {
      const Emitters::Sky sky = world.emitters.environment(ray.direction);
      (straight ? (sky.sampled_directly ? arrival.lamp : arrival.sky) : first.emission) +=
          first.throughput * sky.radiance;
      first.path_length = infinity;
      return arrival;
    }
    point.medium = medium_before(point, inside);
    first.path_length += hit.distance;
    first.throughput *= transmittance(point.medium, hit.distance);
    (straight ? arrival.lamp : first.emission) += first.throughput * point.emission;

    const Vec3 wo = -ray.direction;
    const float specular = point.bsdf.has_specular() ? lobe_chances(point.bsdf, wo).specular : 0;
    const Vec2 u = specular > 0 ? sampler.next2() : Vec2{};
    if (!(specular > 0 && u.x < specular)) {
      if (specular > 0) first.throughput = first.throughput / (1 - specular);
      first.point = point;
      return arrival;
    }
    if (depth + first.depth >= world.max_depth) return arrival;
    const BsdfSample next = sample_specular(point.bsdf, wo, u.y);
    first.throughput *= next.weight / specular;
    const bool crosses = dot(next.direction, point.geometric_normal) < 0;
    if (is_black(first.throughput) || crosses != next.transmitted) return arrival;
    if (next.transmitted && point.bsdf.solid) inside = point.front ? point.attenuation : Rgb{};
    ++first.depth;
    if (!survives(first.throughput, first.depth, sampler)) return arrival;
    ray = {offset_origin(point, next.direction), next.direction};
  }
}

FirstPoint first_point(const World& world, const Ray& ray, bool see_lamps, Sampler& sampler, std::uint64_t& kind,
                       const Rgb& inside, FirstSegment first_segment, int depth) {
  Arrival arrival = follow(world, ray, inside, depth, sampler, kind, first_segment);
  arrival.first.emission += arrival.sky;
  if (see_lamps) arrival.first.emission += arrival.lamp;
  return arrival.first;
}

}  // namespace isophote
