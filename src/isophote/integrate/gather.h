#pragma once

#include "isophote/derivatives/sphere_gather.h"
#include "isophote/integrate/far_light.h"

namespace isophote {

/// A place for records: a surface point with no more of its material than what is wanted there.
struct Place {
  Vec3 position;
  Vec3 geometric_normal;
  Vec3 normal;            ///< interpolated: the hemisphere is about it
  float pixel = 0;        ///< length a pixel spans there
  float offset = 0;       ///< SurfacePoint::offset
  Rgb medium{};           ///< SurfacePoint::medium
  std::uint64_t key = 0;  ///< seeds what is computed here: a hash of the camera sample that asked
  bool diffuse = true;    ///< irradiance is wanted
  int bands = 0;          ///< of incident radiance, if any are wanted
};

/// What it asks the cache, without a normal map: the hemisphere is about the interpolated normal.
inline Query query_at(const Place& place) { return {place.position, place.normal, place.normal}; }

/// One ray into each stratum of the hemisphere above `place`. Radiance is a path's, or, where `from` is not none,
/// direct light plus what that knows; emission of directly sampled emitters at the first hit is left out. Where the
/// world has media, samples have layers. `key` seeds the record.
void gather_hemisphere(const World& world, const FarLight& from, const Place& place, Strata strata, std::uint64_t key,
                       HemisphereGather& gather, RayCounts& counts);

/// The same over the sphere about a point of the world's media, which lies in a solid of absorption `inside` (1/m).
void gather_sphere(const World& world, const FarLight& from, const Vec3& position, const Rgb& inside,
                   SphereStrata strata, std::uint64_t key, SphereGather& gather, RayCounts& counts);

}  // namespace isophote
