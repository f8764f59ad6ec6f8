#pragma once

#include <span>
#include <vector>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// What a few places, well spread over the picture, say of all, before the first record: what metrics that aim at a
/// mean error, and rays that adapt, want to know. `jets` are of the places, in their order, by gathers like those of
/// records, and leave samples in the cells of `cache`.
struct Survey {
  Pilot pilot;
  std::vector<Jet<Rgb>> jets;
};
Survey survey(const Job& job, RecordCache& cache, std::span<const Place> places, RayCounts& counts);

/// Does a method want a survey, does a job still want one, and of how many places?
bool wants_survey(const Method& method);
inline bool must_survey(const Job& job) { return wants_survey(job.method) && !job.pilot.known; }
inline constexpr std::size_t surveyed_places = 64;

/// Random visible places for a survey where no others are at hand.
std::vector<Place> random_places(const Job& job, RayCounts& counts);

/// What gathers are to read where they hit.
struct Seeding {
  Secondary chosen = Secondary::off;
  double gain = 0;  ///< of cells over paths, in the variance of a gather times its rays; 0: not asked
};
/// Has the rays of a few random places leave samples in the cache's cells, where the method may read those and there
/// are none yet; decides whether they are worth it, where that is asked.
Seeding seed_cells(const Job& job, RecordCache& cache, RayCounts& counts);

}  // namespace isophote
