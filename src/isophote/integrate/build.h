#pragma once

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// What building a cache took.
struct BuildReport {
  std::size_t rounds = 0;
  int passes = 0;  ///< over all pixels, each through another sample of them
  RayCounts rays;
  bool cancelled = false;
};

/// Fills `cache` in rounds until the picture's pixels are covered. In each round, in parallel and reading only what
/// earlier rounds wrote, a batch of uncovered points well apart becomes records; these are then inserted and settled in
/// order. Image levels go from coarse to fine; the finest is repeated, each time through other points of the pixels,
/// until next to none is uncovered. The result does not depend on the number of threads. Records that are there already
/// are kept.
BuildReport build_in_rounds(const Job& job, RecordCache& cache);

/// The record at a place. Its random numbers depend on the place's key alone, not on the records before it.
Record make_record(const Job& job, const RecordCache& cache, const Place& place, HemisphereGather& scratch,
                   RayCounts& counts);

/// The place a camera sample asks to be covered, with the sample's key where something is to be computed; none
/// where it meets nothing that scatters diffusely.
std::optional<Place> place_of(const Job& job, const FirstPoint& seen, std::uint64_t key = 0);

/// An empty cache over the job's scene.
RecordCache empty_cache(const Job& job);

}  // namespace isophote
