#pragma once

#include "isophote/integrate/build.h"

namespace isophote {

/// Improves a cache for a job whose threshold has been lowered: the records at `places`, which are the last of the
/// cache in their order, take the footprints of the new threshold; those whose rays adapt and are too few by half are
/// gathered anew, with other random numbers; and rounds add records where the smaller footprints leave points
/// uncovered. Records before them, of which no place is known, stay as they are. The report counts what this took; its
/// places are those of all but those records.
BuildReport refine(const Job& job, RecordCache& cache, std::span<const Place> places);

/// The threshold with which to refine, where `measured` exceeds the error that `a` aimed at.
float refined_threshold(const Method& method, double measured);

}  // namespace isophote
