#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// The records over a dimmed picture of the irradiance: each with a dot where it lies and the rim of its footprint,
/// coloured by the radius against the others' (dark: small). Meant for sRGB display without further exposure.
RgbImage record_picture(const Job& job, const RecordCache& cache);

}  // namespace isophote
