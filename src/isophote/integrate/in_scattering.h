#pragma once

#include "isophote/integrate/far_light.h"

namespace isophote {

/// Light that a medium scatters at a point back along a ray of `direction`, per unit of sigma_s, but for light of
/// directly sampled emitters: from records of volume radiance. Nothing where they do not cover the point, or where
/// there are none.
std::optional<Rgb> cached_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                        const Vec3& direction, RayCounts& counts);

/// The same as the eye sees it: where the medium's phase function is too narrow for the bands of records, edges of
/// what surfaces and the sky send would be missed, which is found by a ray instead; what media send is smoother.
/// `depth` counts the scattering events before the point's.
std::optional<Rgb> seen_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                      const Vec3& direction, int depth, Sampler& sampler, RayCounts& counts);

}  // namespace isophote
