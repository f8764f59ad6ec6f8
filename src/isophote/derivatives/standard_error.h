#pragma once

#include <span>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// The variance of each sample's radiance, in luminance: from what neighbouring strata differ by. In memory of the
/// calling thread, which its next call reuses.
std::span<const double> stratum_variances(const HemisphereGather& gather);
/// Of any luminances, ring by ring, in rings of `azimuthal`.
std::span<const double> stratum_variances(std::span<const double> seen, int polar, int azimuthal);

/// The standard error of the irradiance that is the mean over a gather's strata, in luminance, W/m2: from what
/// neighbouring strata differ by. Within a stratum radiance varies no more than that where the strata are fine, so that
/// it errs upwards, and is 0 in a furnace.
double standard_error(const HemisphereGather& gather);

}  // namespace isophote
