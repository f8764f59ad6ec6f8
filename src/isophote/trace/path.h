#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "isophote/sampling/sampler.h"
#include "isophote/scene/emitter.h"
#include "isophote/trace/media.h"
#include "isophote/trace/ray_caster.h"

namespace isophote {

/// What light transport runs on. A plain view; copy it freely.
struct World {
  const Scene& scene;
  const RayCaster& rays;
  const Emitters& emitters;
  int max_depth = std::numeric_limits<int>::max();  ///< scattering events after the camera; 1: direct light only
  const Media* media = nullptr;                     ///< null: there are none

  /// The same without its media: what a camera would see on a clear day.
  World clear() const { return {scene, rays, emitters, max_depth}; }
};

/// Rays cast, by purpose. Each worker counts for itself.
struct RayCounts {
  std::uint64_t camera = 0, path = 0, shadow = 0, gather = 0, check = 0, verification = 0;
  std::uint64_t total() const { return camera + path + shadow + gather + check + verification; }
  RayCounts& operator+=(const RayCounts& o);
};

/// The first point that scatters other than specularly, along a ray through mirrors and glass: on a surface or, by
/// chance, in a medium.
struct FirstPoint {
  std::optional<SurfacePoint> point;  ///< neither: the ray left the scene, died or met only specular surfaces
  std::optional<MediumPoint> medium_point;
  Rgb emission;           ///< radiance emitted towards the ray's origin along the way and at the point, tinted; with
                          ///< the light of point and spot lights that media scatter once on the way
  Rgb throughput{1.0f};   ///< of the specular surfaces and the media before the point
  Vec3 direction;         ///< of the last segment
  float path_length = 0;  ///< from the origin, over all segments
  float first_distance = infinity;  ///< to the very first surface, of any kind; infinity: the sky
  Vec3 first_normal;                ///< geometric normal there, towards the ray
  std::uint32_t first_mesh = 0;
  int depth = 0;  ///< specular events on the way

  bool scatters() const { return point || medium_point; }
};

/// Do media act on a ray before its first surface, or does the caller account for what they do there?
enum class FirstSegment : std::uint8_t { in_media, clear };

/// Follows `ray` to its first non-specular point. Media scatter it by chance, which `throughput` makes up for, or not
/// at all where the world has none. A surface with specular and other lobes is passed or stopped at by
/// chance, which `throughput` makes up for: what scatters at the point is its diffuse and glossy lobes. `emission`
/// counts directly sampled emitters (lamps, the environment's peaks) met before any specular event only where
/// `see_lamps`; whatever is met after one counts always (no light sample could have found it). `kind` is the counter to
/// charge, shadow rays to point and spot lights from media included; `inside` the absorption (1/m) of the medium that
/// the ray starts in; `depth` the events before.
FirstPoint first_point(const World& world, const Ray& ray, bool see_lamps, Sampler& sampler, std::uint64_t& kind,
                       const Rgb& inside = {}, FirstSegment first_segment = FirstSegment::in_media, int depth = 0);

/// Light scattered at a point towards `wo`, split as the project defines it: `direct` from directly sampled emitters
/// scattered once here, `indirect` everything else. `irradiance` is the indirect irradiance on the diffuse lobe's
/// hemisphere (about the mapped normal), of which diffuse_albedo / pi is part of `indirect`.
struct Scattered {
  Rgb direct, indirect, irradiance;
};

/// One-path estimate by next-event estimation, multiple importance sampling and Russian roulette, unbiased.
/// `depth` is the number of scattering events before this one.
Scattered scatter(const World& world, const SurfacePoint& point, const Vec3& wo, int depth, Sampler& sampler,
                  RayCounts& counts);

/// The same in a medium; there is no irradiance. What point and spot lights send here directly is not in it: in media
/// they have an estimator of their own, and what `first_point` says is emitted along a ray contains their light that
/// media scatter there once (`placed_lights_along`). `direction`
/// is that of the ray from the viewer.
Scattered scatter(const World& world, const MediumPoint& point, const Vec3& direction, int depth, Sampler& sampler,
                  RayCounts& counts);

/// Radiance that a path brings from where `first` ended, `depth` events before that: all that is scattered there.
Rgb path_radiance(const World& world, const FirstPoint& first, int depth, Sampler& sampler, RayCounts& counts);

/// The `direct` part alone, of the diffuse lobe or of that and the glossy one: radiance towards `wo`.
Rgb direct_light(const World& world, const SurfacePoint& point, const Vec3& wo, bool glossy_too, Sampler& sampler,
                 RayCounts& counts);

/// Light of directly sampled emitters, but of point and spot lights, that a medium scatters once, by light sampling
/// alone: radiance on the way back along a ray of `direction`. `slope`, if given, is increased by its gradient on the
/// sphere of directions.
Rgb direct_light(const World& world, const MediumPoint& point, const Vec3& direction, Sampler& sampler,
                 RayCounts& counts, Gradient<Rgb>* slope = nullptr);

/// One ray of the glossy lobe. `direct`: the glossy lobe's light from directly sampled emitters (light sampling and
/// this ray share by MIS). `next` is where the ray goes on, with `next.emission` free of what `direct` holds; indirect
/// light of the lobe is weight * (next.emission + next.throughput * radiance scattered at next.point).
struct GlossyRay {
  Rgb direct;
  Rgb weight;
  FirstPoint next;
};
GlossyRay glossy_ray(const World& world, const SurfacePoint& point, const Vec3& wo, Sampler& sampler,
                     RayCounts& counts);

}  // namespace isophote
