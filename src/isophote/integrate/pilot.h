#pragma once

#include <span>
#include <vector>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// What a few places, well spread over the picture, say of all, before the first record: what metrics that aim at a
/// mean error, and rays that adapt, want to know. `jets` are of the places, in their order, by gathers like those of
/// records.
struct Survey {
  Pilot pilot;
  std::vector<Jet<Rgb>> jets;
};
Survey survey(const Job& job, std::span<const Place> places, RayCounts& counts);

/// Does a method want a survey, does a job still want one, and of how many places?
bool wants_survey(const Method& method);
inline bool must_survey(const Job& job) { return wants_survey(job.method) && !job.pilot.known; }
inline constexpr std::size_t surveyed_places = 64;

/// Random visible places for a survey where no others are at hand.
std::vector<Place> random_places(const Job& job, RayCounts& counts);

}  // namespace isophote
