#pragma once

#include "isophote/derivatives/volume_radiance.h"
#include "isophote/validity/radius_bounds.h"

namespace isophote {

/// For records in media: a times the length over which radiance changes by as much as itself, judged sample by sample,
///   R = a sum |L_i| / sum |grad L_i|   [Jarosz 2008a],
/// so that it stays short where the gradients of several lights cancel. No length is above the scene's diagonal.
/// `bounds` act on the radius, but that by the gradient on the length: for estimators that see occlusion, whose
/// gradient has more than those of the samples. Where a is above 1 no radius is above L / |grad L|: over more than
/// that, geometric means of what records say sink far below the truth.
Footprint relative_change(const VolumeJet& jet, const View& view, float a, const RadiusBounds& bounds);

}  // namespace isophote
