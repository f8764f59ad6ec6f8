#pragma once

#include "isophote/integrate/build.h"

namespace isophote {

/// Improves a cache for a job whose threshold has been lowered: its records, which were made at `places` in their
/// order, take the footprints of the new threshold; those whose rays adapt and are too few by half are gathered anew,
/// with other random numbers; and rounds add records where the smaller footprints leave points uncovered. The report
/// counts what this took; its places are those of all records. A host that cancels gets the cache as it was.
BuildReport refine(const Job& job, RecordCache& cache, std::span<const Place> places);

/// The threshold with which to refine where `measured` exceeds the mean relative error that was asked.
float refined_threshold(const Method& method, double asked, double measured);

}  // namespace isophote
