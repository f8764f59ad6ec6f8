#pragma once

#include "isophote/trace/path.h"

namespace isophote {

/// Beer and Lambert's law: what is left after `distance` (finite) in a medium that absorbs `sigma` (1/m).
Rgb transmittance(const Rgb& sigma, float distance);

/// The share of a light sample that reaches `point`: 0 behind anything, less than 1 inside an absorbing solid. Light of
/// delta lights, which no ray chosen by a BSDF could meet, also comes straight through thin transmissive sheets, by up
/// to 32 of them; these count as no scattering events. All other light through glass is left to the paths that pass it.
Rgb light_transmittance(const World& world, const SurfacePoint& point, const LightSample& light, std::uint32_t seed,
                        RayCounts& counts);

/// A place of a surface.
struct Spot {
  Vec3 position, normal;
};

/// Is the way free from one spot to another that faces alike, at the height of half a tenth of their distance over
/// both? Alpha-masked surfaces stop it where they are opaque; glass does too, since it parts what is lit differently.
bool open_between(const World& world, const Spot& a, const Spot& b, RayCounts& counts);

}  // namespace isophote
