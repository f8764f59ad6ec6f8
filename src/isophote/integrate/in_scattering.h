#pragma once

#include "isophote/integrate/far_light.h"

namespace isophote {

/// Light that a medium scatters at a point back along a ray of `direction`, per unit of sigma_s, but for light of
/// directly sampled emitters: from records of volume radiance. Nothing where they do not cover the point, or where
/// there are none.
std::optional<Rgb> cached_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                        const Vec3& direction, RayCounts& counts);

}  // namespace isophote
