#include "isophote/integrate/pilot.h"

#include <array>
#include <cmath>

#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/make_record.h"
#include "isophote/validity/total_error.h"

namespace isophote {
namespace {

/// Of each place that fills cells: fewer would not fill them enough to tell what they are worth.
constexpr int seeding_rays = 200;

/// The job's estimator at all places, at each by strata(i).
template <class StrataOf>
std::vector<Jet<Rgb>> jets_at(const Job& job, RecordCache& cache, std::span<const Place> places, StrataOf&& strata,
                              RayCounts& counts) {
  std::vector<Jet<Rgb>> jets(places.size());
  std::vector<IrradianceCells> left(places.size());
  counts += for_each(job.parallel, places.size(), 1, [&](std::size_t i, RayCounts& each) {
    thread_local HemisphereGather scratch;
    jets[i] = jet_at(job, cache, places[i], strata(i), scratch, left[i], each);
  });
  take_in(job.world, cache.cells(), left, counts);
  return jets;
}

float mean_irradiance(std::span<const Jet<Rgb>> jets) {
  double sum = 0;
  for (const Jet<Rgb>& jet : jets) sum += luminance(jet.value);
  return static_cast<float>(sum / static_cast<double>(jets.size()));
}

}  // namespace

bool wants_survey(const Method& method) { return method.caches() && (method.metric->needs > 1 || method.adaptive); }

Survey survey(const Job& job, RecordCache& cache, std::span<const Place> places, RayCounts& counts) {
  Survey result;
  if (places.empty()) return result;
  Pilot& pilot = result.pilot;
  pilot.known = true;
  std::vector<Strata> strata(places.size(), job.strata);
  if (job.method.adaptive) {
    std::vector<Place> ahead(places.begin(), places.end());
    for (Place& place : ahead) place.key = hash(static_cast<std::uint64_t>(Purpose::pilot), place.key);
    const auto coarse = jets_at(
        job, cache, ahead, [](std::size_t) { return Strata::about(fewest_rays); }, counts);
    pilot.irradiance = mean_irradiance(coarse);
    double rate = 0;
    for (const Jet<Rgb>& jet : coarse) rate += std::cbrt(std::pow(relative_spread(jet, pilot), 2));
    pilot.noise_rate = static_cast<float>(rate / static_cast<double>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i)
      strata[i] = strata_for(relative_spread(coarse[i], pilot), pilot, job.method.noise());
  }
  result.jets = jets_at(
      job, cache, places, [&](std::size_t i) { return strata[i]; }, counts);
  pilot.irradiance = mean_irradiance(result.jets);
  double rate = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    rate += error_rate(result.jets[i], places[i].normal, pilot.irradiance);
  pilot.error_rate = static_cast<float>(rate / static_cast<double>(places.size()));
  return result;
}

std::vector<Place> random_places(const Job& job, RayCounts& counts) {
  const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::pilot), job.seed);
  std::vector<Place> places;
  constexpr std::size_t most_tries = 64 * surveyed_places;
  for (std::size_t i = 0; i < most_tries && places.size() < surveyed_places; ++i) {
    Sampler stream(key, static_cast<std::uint32_t>(i));
    if (const auto seen = random_place(job, stream, hash(key, i), counts)) places.push_back(seen->place);
  }
  return places;
}

Seeding seed_cells(const Job& asked, RecordCache& cache, RayCounts& counts) {
  Seeding seeding{asked.method.secondary};
  if (seeding.chosen == Secondary::off) return seeding;
  if (!cache.cells().cells().empty()) {
    if (seeding.chosen == Secondary::automatic) seeding.chosen = Secondary::records;
    return seeding;
  }
  Job job = asked;
  job.method.secondary = Secondary::cells;
  std::vector<Place> places = random_places(job, counts);
  // The first time all paths go on, for there is nothing yet; the second time many end in cells.
  std::array<double, 2> cost{};
  for (std::size_t round = 0; round < cost.size(); ++round) {
    RayCounts rays;
    double deviation = 0;
    for (Place& place : places) place.key = hash(place.key, round);
    for (const Jet<Rgb>& jet : jets_at(
             job, cache, places, [](std::size_t) { return Strata::about(seeding_rays); }, rays))
      deviation += jet.standard_error;
    cost[round] = deviation * deviation * static_cast<double>(rays.total());
    counts += rays;
  }
  if (cost[1] > 0) seeding.gain = cost[0] / cost[1];
  const bool better = !(cost[1] > cost[0]);
  if (seeding.chosen == Secondary::automatic) seeding.chosen = !better ? Secondary::off : Secondary::records;
  if (seeding.chosen == Secondary::off) cache.cells() = IrradianceCells(cache.bounds());
  return seeding;
}

}  // namespace isophote
