#pragma once

#include "isophote/derivatives/incident_radiance.h"

namespace isophote {

/// Irradiance with the translational gradient in surface-area form [Arvo 1994], [Krivanek 2005a]: each sample stands
/// for a small piece of the surface it met, seen by the moving record as if nothing ever came between. Unaware of
/// occlusion.
Jet<Rgb> krivanek_2005a(const HemisphereGather& gather);

/// Incident radiance with its gradient by the same pieces.
RadianceJet krivanek_2005a(const HemisphereGather& gather, Basis basis, int order);

}  // namespace isophote
