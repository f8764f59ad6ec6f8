#pragma once

#include "isophote/core/rgb.h"
#include "isophote/derivatives/jet.h"
#include "isophote/validity/footprint.h"

namespace isophote {

/// The split-sphere metric [Ward, Rubinstein, Clear 1988]: the error at distance d and normal n is
///   eps = (4/pi) d / R + sqrt(1 - n . n_i),   R the harmonic mean distance of what the record sees,
/// and the record is used where eps < a. No other limit, but that under an open sky R is the scene's diagonal,
/// and that the radius stays above smallest_radius.
Footprint split_sphere(const DistanceStats& distances, const View& view, float a);

/// The radius at which the split sphere's distance term alone reaches `a`.
float split_sphere_radius(float harmonic_mean, float a);

}  // namespace isophote
