#include "isophote/trace/shadow.h"

#include <algorithm>
#include <cmath>

namespace isophote {
namespace {

Ray shadow_ray(const Vec3& origin, const LightSample& light) {
  Ray ray{origin, light.direction};
  if (light.distance == infinity) return ray;
  // Aimed anew, from off the surface to off the emitter, which would else hide itself.
  const Vec3 to = light.end - ray.origin;
  ray.far = 0;  // where the two offsets meet, nothing is between
  if (!(dot(to, light.direction) > 0)) return ray;
  ray.far = length(to);
  ray.direction = to / ray.far;
  return ray;
}

Rgb through_sheets(const World& world, Ray ray, const LightSample& light, std::uint32_t seed, RayCounts& counts) {
  constexpr int most_sheets = 32;
  Rgb passed(1.0f);
  for (int sheets = 0; sheets <= most_sheets; ++sheets) {
    Hit hit;
    ++counts.shadow;
    if (!world.rays.intersect(ray, seed, hit)) return passed;
    const SurfacePoint sheet = surface_point(world.scene, ray, hit);
    passed *= sheet_transmittance(sheet.bsdf, -ray.direction);
    if (is_black(passed)) break;
    ray = shadow_ray(offset_origin(sheet, light.direction), light);
  }
  return {};
}

}  // namespace

Rgb transmittance(const Rgb& sigma, float distance) { return is_black(sigma) ? Rgb(1.0f) : exp(sigma * -distance); }

Rgb light_transmittance(const World& world, const ShadowStart& start, const LightSample& light, std::uint32_t seed,
                        RayCounts& counts) {
  const Ray ray = shadow_ray(start.origin, light);
  Rgb passed(1.0f);
  if (light.delta && world.rays.has_sheets()) {
    passed = through_sheets(world, ray, light, seed, counts);
  } else {
    ++counts.shadow;
    if (world.rays.occluded(ray, seed)) return {};
  }
  if (world.media && !is_black(passed)) passed *= world.media->transmittance(ray, seed);
  // A closed solid hides what is infinitely far.
  return light.distance < infinity ? passed * transmittance(start.inside, light.distance) : passed;
}

bool open_between(const World& world, const Spot& a, const Spot& b, RayCounts& counts) {
  const Vec3 way = b.position - a.position, normals = a.normal + b.normal;
  const float distance = length(way), size = length(normals);
  if (!(distance > 0 && size > 0)) return true;
  // An arc whose normals turn by t bulges over its chord by t / 8 of it: the way leads over that twice, and off even
  // ground by more than the coordinates are rounded.
  constexpr float off_ground = 0.05f, over_bulge = 0.25f, rounding = 0x1p-19f;
  const auto largest = [](const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const float lift = distance * (off_ground + over_bulge * length(a.normal - b.normal)) +
                     rounding * std::max(largest(a.position), largest(b.position));
  // It starts and ends a little short of what touches the surface just there.
  constexpr float short_of = 0x1p-20f;
  const Ray ray{a.position + normals * (lift / size), way / distance, short_of * distance, (1 - short_of) * distance};
  ++counts.verification;
  return !world.rays.occluded(ray, 0);
}

bool open_between(const World& world, const Vec3& a, const Vec3& b, RayCounts& counts) {
  const Vec3 way = b - a;
  const float distance = length(way);
  if (!(distance > 0)) return true;
  ++counts.verification;
  return !world.rays.occluded({a, way / distance, 0, distance}, 0);
}

}  // namespace isophote
