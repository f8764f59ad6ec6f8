#pragma once

#include <vector>

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"
#include "isophote/harmonics/basis.h"

namespace isophote {

/// Radiance arriving at a record (W/m2/sr, no cosine) as coefficients of a basis in its local frame: order^2 of them,
/// by `harmonic_index`.
using Coefficients = std::vector<Rgb>;

/// The same with what it changes by as the record moves. Its translational gradient is in the record's own frame: x and
/// y along u and v, z empty; the rotational one is empty, for a turn about the normal is exact on the coefficients and
/// what a tilt uncovers under the horizon is not known.
using RadianceJet = Jet<Coefficients>;

/// Radiance without derivatives: each sample stands for its stratum, over which the basis is integrated exactly.
RadianceJet incident_radiance(const HemisphereGather& gather, Basis basis, int order);

}  // namespace isophote
