#pragma once

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"

namespace isophote {

/// `krivanek_2005a` with the radiometric Hessian [Jarosz 2012], the second derivative of the same sum.
Jet<Rgb> jarosz_2012(const HemisphereGather& gather);

}  // namespace isophote
