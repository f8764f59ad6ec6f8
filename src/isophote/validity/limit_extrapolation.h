#pragma once

#include "isophote/validity/volume_record.h"

namespace isophote {

/// Limits a record's translational gradient so that no extrapolation within its footprint explodes: |grad E| R <= E in
/// each channel, and where the radius was raised to its lower bound from r, the gradient is scaled by r / R [Krivanek
/// 2006]. The Hessian is scaled so that it bends the value by no more than a quarter of its luminance. `natural_radius`
/// is r: what the radius would be without the lower bound. Called again whenever the radius changes.
void limit_extrapolation(Record& record, float natural_radius);
/// The same of all coefficients together, in the root of the sum of their squares; there is no Hessian.
void limit_extrapolation(RadianceRecord& record, float natural_radius);
/// In media by |grad L| R <= L alone, R as far as the footprint reaches along the gradient, of all coefficients of a
/// channel together: the correct gradient of a record beside an edge may hold over a hundredth of the radius that a
/// lower bound leaves it.
void limit_extrapolation(VolumeRecord& record);

}  // namespace isophote
