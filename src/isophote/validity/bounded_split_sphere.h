#pragma once

#include "isophote/derivatives/jet.h"
#include "isophote/validity/radius_bounds.h"

namespace isophote {

/// The split-sphere metric with its radius bounded, on the unscaled radius by the gradient, on the used one by the
/// rest. Of irradiance or incident radiance.
template <class V>
Footprint bounded_split_sphere(const Jet<V>& jet, const View& view, float a, const RadiusBounds& bounds);

}  // namespace isophote
