#pragma once

#include "isophote/integrate/job.h"

namespace isophote {

/// What the job's metric wants to know of the whole picture before the first record: means over random visible points,
/// each with a gather of few rays, which radii need no more of. Nothing is done for metrics that do not ask.
Pilot run_pilot(const Job& job, RayCounts& counts);

}  // namespace isophote
