#pragma once

#include "isophote/trace/path.h"

namespace isophote {

/// Beer and Lambert's law: what is left after `distance` (finite) in a medium that absorbs `sigma` (1/m).
Rgb transmittance(const Rgb& sigma, float distance);

/// Where a shadow ray starts, and in what.
struct ShadowStart {
  Vec3 origin;  ///< off the surface, if it is on one
  Rgb inside;   ///< sigma_a (1/m) of the solid that it lies in

  ShadowStart(const SurfacePoint& point, const Vec3& direction)
      : origin(offset_origin(point, direction)), inside(point.medium) {}
  ShadowStart(const MediumPoint& point, const Vec3&) : origin(point.position), inside(point.inside) {}
};

/// The share of a light sample that reaches a point: 0 behind anything, less than 1 through media. Light of delta
/// lights, which no ray chosen by a BSDF could meet, also comes straight through thin transmissive sheets, by up to 32
/// of them; these count as no scattering events. All other light through glass is left to the paths that pass it.
Rgb light_transmittance(const World& world, const ShadowStart& start, const LightSample& light, std::uint32_t seed,
                        RayCounts& counts);

/// A place of a surface.
struct Spot {
  Vec3 position, normal;
};

/// Is the way free from one spot to another that faces alike, at the height of half a tenth of their distance over
/// both? Alpha-masked surfaces stop it where they are opaque; glass does too, since it parts what is lit differently.
bool open_between(const World& world, const Spot& a, const Spot& b, RayCounts& counts);
/// And straight from one place in a medium to another?
bool open_between(const World& world, const Vec3& a, const Vec3& b, RayCounts& counts);

}  // namespace isophote
