#pragma once

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"
#include "isophote/integrate/pilot.h"

namespace isophote {

/// What building a cache took.
struct BuildReport {
  std::size_t rounds = 0;
  int passes = 0;  ///< over all pixels, each through another sample of them
  RayCounts rays;
  Pilot pilot{};              ///< of the survey, where the method wanted one
  Seeding seeding{};          ///< what gathers read where they hit
  std::vector<Place> places;  ///< of the records added, in their order
  bool cancelled = false;
};

/// Fills `cache` in rounds until the picture's pixels are covered. In each round, in parallel and reading only what
/// earlier rounds wrote, a batch of uncovered points well apart becomes records; these are then inserted and settled in
/// order. Image levels go from coarse to fine; the finest is repeated, each time through other points of the pixels,
/// until next to none is uncovered. The result does not depend on the number of threads. Records that are there already
/// are kept.
BuildReport build_in_rounds(const Job& job, RecordCache& cache);

/// An empty cache over the job's scene.
RecordCache empty_cache(const Job& job);

}  // namespace isophote
