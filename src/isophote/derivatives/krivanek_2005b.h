#pragma once

#include "isophote/derivatives/incident_radiance.h"

namespace isophote {

/// Incident radiance with the translational gradient of the stratified hemisphere [Krivanek 2005b]: radiance steps over
/// the walls between strata, each wall on the nearer of the two surfaces beside it, the basis integrated along it
/// exactly. Knows occlusion.
RadianceJet krivanek_2005b(const HemisphereGather& gather, Basis basis, int order);

}  // namespace isophote
