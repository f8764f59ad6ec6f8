#pragma once

#include "isophote/derivatives/incident_radiance.h"
#include "isophote/derivatives/jet.h"

namespace isophote {

/// The distance over which a value changes by as much as itself, by its gradient [Krivanek 2006]: E / |grad E| for the
/// channel in which it is least; infinity where nothing changes.
float gradient_radius(const Jet<Rgb>& jet);
/// The same of the vector of all coefficients of a channel: on surfaces and in media.
float gradient_radius(const RadianceJet& jet);

}  // namespace isophote
