#pragma once

#include "isophote/cache/radiance_cache.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// Adaptive radii of records of incident radiance [Krivanek 2006]: where records overlap in the picture and what they
/// say is reflected to the viewer differs by more than the method's contrast, all but the one that weighs most there
/// shrink until they no longer reach so far, within their bounds and not to less than half at once. Looks at sample
/// `sample` of every stride-th pixel.
void adapt_radii(const Job& job, RadianceCache& cache, int stride, int sample, RayCounts& counts);

}  // namespace isophote
