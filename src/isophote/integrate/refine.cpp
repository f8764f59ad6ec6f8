#include "isophote/integrate/refine.h"

#include <algorithm>

#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/pilot.h"

namespace isophote {
namespace {

/// What the estimator says of a place now: as before, unless the rays are too few for the job's noise.
Jet<Rgb> refined_jet(const Job& job, const RecordCache& cache, const Jet<Rgb>& before, Place place,
                     HemisphereGather& scratch, RayCounts& counts) {
  if (!job.method.adaptive) return before;
  const Strata wanted = strata_for(relative_spread(before, job.pilot), job.pilot, job.method.noise());
  if (static_cast<double>(wanted.size()) < 1.5 * before.rays) return before;
  place.key = hash(place.key, before.rays);
  return jet_at(job, job.method.secondary ? &cache : nullptr, place, wanted, scratch, counts);
}

}  // namespace

BuildReport refine(const Job& asked, RecordCache& cache, std::span<const Place> places) {
  Job job = asked;
  RayCounts rays;
  // With more rays Hessians are less noisy, and say less of what the mean error is.
  if (wants_survey(job.method)) job.pilot = survey(job, random_places(job, rays), rays).pilot;
  const std::size_t kept = cache.records().size() - places.size();
  std::vector<Record> records(cache.records().begin(), cache.records().end());
  rays += for_each(job.parallel, places.size(), 1, [&](std::size_t i, RayCounts& counts) {
    thread_local HemisphereGather scratch;
    Record& record = records[kept + i];
    const Jet<Rgb> jet = refined_jet(job, cache, record.jet, places[i], scratch, counts);
    record = job.method.make_record(record.position, record.normal, jet, view_of(job, places[i]));
  });
  RecordCache refined(cache.bounds());
  for (const Record& record : records) {
    const std::uint32_t id = refined.insert(record);
    job.method.settle(refined.settling(), {&id, 1});
  }
  cache = std::move(refined);
  BuildReport report = build_in_rounds(job, cache);
  report.rays += rays;
  report.places.insert(report.places.begin(), places.begin(), places.end());
  return report;
}

float refined_threshold(const Method& method, double measured) {
  constexpr double at_most = 0.25;  // of the threshold in one step, for a measurement may be far off
  const double aim = method.error();
  return method.settings.a * threshold(*method.metric, aim * std::max(at_most, 0.9 * aim / measured)) /
         threshold(*method.metric, aim);
}

}  // namespace isophote
