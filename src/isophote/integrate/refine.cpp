#include "isophote/integrate/refine.h"

#include <algorithm>

#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/pilot.h"

namespace isophote {
namespace {

/// What the estimator says of a place now: as before, unless the rays are too few for the job's noise. How many it
/// wants other records say: were those kept whose own gather saw little noise, the mean would fall.
Jet<Rgb> refined_jet(const Job& job, const RecordCache& cache, const Jet<Rgb>& before, Place place,
                     HemisphereGather& scratch, IrradianceCells& left, RayCounts& counts) {
  if (!job.method.adaptive) return before;
  const Strata wanted = strata_near(job, cache, place);
  if (static_cast<double>(wanted.size()) < 1.5 * before.rays) return before;
  place.key = hash(place.key, before.rays);
  return jet_at(job, cache, place, wanted, scratch, left, counts);
}

}  // namespace

BuildReport refine(const Job& asked, RecordCache& cache, std::span<const Place> places) {
  constexpr std::size_t between_stops = 64;  // records, after which the host is asked whether to go on
  Job job = asked;
  BuildReport report;
  // With more rays Hessians are less noisy, and say less of what the mean error is.
  job.method.secondary = seed_cells(job, cache, report.rays).chosen;
  if (wants_survey(job.method)) job.pilot = survey(job, cache, random_places(job, report.rays), report.rays).pilot;
  std::vector<Record> records(cache.records().begin(), cache.records().end());
  for (std::size_t from = 0; from < places.size(); from += between_stops) {
    if (job.progress.stop()) {
      report.pilot = asked.pilot, report.seeding.chosen = asked.method.secondary, report.cancelled = true;
      report.places.assign(places.begin(), places.end());
      return report;
    }
    job.progress.tell("refine", static_cast<double>(from) / static_cast<double>(places.size()));
    const std::size_t count = std::min(between_stops, places.size() - from);
    std::vector<IrradianceCells> left(count);
    report.rays += for_each(job.parallel, count, 1, [&](std::size_t i, RayCounts& counts) {
      thread_local HemisphereGather scratch;
      Record& record = records[from + i];
      const Place& place = places[from + i];
      const Jet<Rgb> jet = refined_jet(job, cache, record.jet, place, scratch, left[i], counts);
      record = job.method.make_record(record.position, record.normal, jet, view_of(job, place));
    });
    take_in(job.world, cache.cells(), left, report.rays);
  }
  RecordCache refined(cache.bounds());
  refined.cells() = std::move(cache.cells());
  refined.set_radiance(cache.radiance());
  refined.set_volumes(cache.volumes());
  for (const Record& record : records) {
    const std::uint32_t id = refined.insert(record);
    job.method.settle(refined.settling(), {&id, 1});
  }
  cache = std::move(refined);
  BuildReport added = build_in_rounds(job, cache);
  added.rays += report.rays;
  added.places.insert(added.places.begin(), places.begin(), places.end());
  return added;
}

float refined_threshold(const Method& method, double asked, double measured) {
  constexpr double at_most = 0.25;  // of the threshold in one step, for a measurement may be far off
  const double aim = method.error(), factor = std::max(at_most, 0.9 * asked / measured);
  return method.settings.a * threshold(*method.metric, aim * factor) / threshold(*method.metric, aim);
}

}  // namespace isophote
