#pragma once

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"
#include "isophote/derivatives/wall_distance.h"

namespace isophote {

/// Irradiance, its mean over the strata, and no derivatives [Ward, Rubinstein, Clear 1988].
Jet<Rgb> irradiance(const HemisphereGather& gather);

/// Which weight a stratum has in the rotational gradient: `classical` is the tangent at its centre, as published, whose
/// bias falls only with the root of the number of rings; `exact` is the stratum's integral.
enum class RotationWeights { classical, exact };

/// The rotational gradient alone, which needs no distances.
Gradient<Rgb> rotational_gradient(const HemisphereGather& gather, RotationWeights weights);

/// Irradiance with the rotational and translational gradients of the stratified hemisphere [Ward, Heckbert 1992]:
/// radiance steps over the walls between strata.
Jet<Rgb> ward_heckbert_1992(const HemisphereGather& gather, RotationWeights weights,
                            WallDistance distance = WallDistance::minimum);

}  // namespace isophote
