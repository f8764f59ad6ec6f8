#pragma once

#include <vector>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// The place a camera sample asks to be covered, with the sample's key where something is to be computed; none where it
/// meets nothing that scatters diffusely.
std::optional<Place> place_of(const Job& job, const FirstPoint& seen, std::uint64_t key = 0);

/// The place of a camera sample with all that is wanted there, incident radiance included; none where nothing is.
std::optional<Place> wanted_place(const Job& job, const FirstPoint& seen, std::uint64_t key = 0);
/// The same with what no record serves; none where all is served.
std::optional<Place> uncovered_place(const Job& job, const RecordCache& cache, const FirstPoint& seen,
                                     std::uint64_t key, RayCounts& counts);
/// Takes out of what is wanted at a place what records serve; false where nothing is left.
bool still_wants(const RecordCache& cache, Place& place, OpenTest open);

/// The place at a random point of the picture, if there is one, as `place_of` has it.
struct SeenPlace {
  Place place;
  Vec2 pixel;  ///< from the top left
};
std::optional<SeenPlace> random_place(const Job& job, Sampler& stream, std::uint64_t key, RayCounts& counts);

/// How the job sees a record at a place.
View view_of(const Job& job, const Place& place);

/// What the job's estimator says of a place, by a gather that reads of the cache what the method says, and leaves
/// samples for its cells in `left`. Its random numbers depend on the place's key alone, not on the records before it.
Jet<Rgb> jet_at(const Job& job, const RecordCache& cache, const Place& place, Strata strata, HemisphereGather& scratch,
                IrradianceCells& left, RayCounts& counts);

/// The records that are wanted at a place, by one gather.
struct NewRecords {
  std::optional<Record> irradiance;
  std::optional<RadianceRecord> radiance;
};
NewRecords make_records(const Job& job, const RecordCache& cache, const Place& place, HemisphereGather& scratch,
                        IrradianceCells& left, RayCounts& counts);

/// Adds records to the cache, in order, and settles them. Ids of those of irradiance are ascending.
struct FreshIds {
  std::vector<std::uint32_t> irradiance, radiance;
};
FreshIds add_records(const Method& method, RecordCache& cache, std::vector<NewRecords> made);

}  // namespace isophote
