#include "in_media/placing.h"

#include <cmath>

#include "isophote/integrate/build.h"
#include "isophote/integrate/gather.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/validity/volume_error.h"

namespace isophote::bench {
namespace {

constexpr VolumePart parts[] = {VolumePart::surfaces, VolumePart::media};

/// As builds have them: build_volumes.cpp.
SphereStrata strata_of(const Job& job) {
  const int polar = static_cast<int>(std::lround(std::sqrt(job.strata.size() / 2.0)));
  return {polar, 2 * polar};
}

View view_of(const Job& job, const SeenPoint& point) {
  View view;
  view.pixel = point.pixel;
  view.picture = point.pixel * static_cast<float>(job.height);
  view.scene_scale = job.world.rays.scene_scale();
  view.pilot = job.pilot;
  return view;
}

void add(const Coefficients& values, float weight, Coefficients& sum) {
  sum.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i] * weight;
}

/// What of a jet records and their metrics use.
void add(const VolumeJet& jet, float weight, VolumeJet& sum) {
  add(jet.value, weight, sum.value);
  add(jet.translational.x, weight, sum.translational.x);
  add(jet.translational.y, weight, sum.translational.y);
  add(jet.translational.z, weight, sum.translational.z);
  sum.hessian += jet.hessian * weight;
  sum.value_sum += jet.value_sum * weight, sum.gradient_sum += jet.gradient_sum * weight;
  for (int i = 0; i < ObstaclesAround::sectors; ++i) sum.obstacles.meet(i, jet.obstacles.distance(i));
}

}  // namespace

Places::Places(const Job& job, std::vector<SeenPoint> points, int gathers)
    : job_(job), gathers_(gathers), points_(std::move(points)), jets_(points_.size()) {}

Places::Jets Places::look(std::size_t i, RayCounts& counts) const {
  thread_local SphereGather gather;
  const SeenPoint& point = points_[i];
  const auto estimators = volume_estimators();
  Jets mean(estimators.size());
  for (int n = 0; n < gathers_; ++n) {
    gather_sphere(job_.world, {}, point.at.position, {}, strata_of(job_), hash(point.key, n), gather, counts);
    for (std::size_t e = 0; e < estimators.size(); ++e)
      for (const VolumePart part : parts)
        add(estimators[e].estimate(gather, part, bands(i)), 1 / static_cast<float>(gathers_),
            mean[e][static_cast<std::size_t>(part)]);
  }
  return mean;
}

const VolumeJet& Places::jet(std::size_t i, const VolumeEstimator& estimator, VolumePart part) {
  RayCounts counts;
  if (!jets_[i]) jets_[i] = look(i, counts);
  const std::ptrdiff_t index = &estimator - volume_estimators().data();
  return (*jets_[i])[static_cast<std::size_t>(index)][static_cast<std::size_t>(part)];
}

void Places::prepare(std::size_t count) {
  for_each(job_.parallel, std::min(count, size()), 1, [&](std::size_t i, RayCounts& counts) {
    if (!jets_[i]) jets_[i] = look(i, counts);
  });
}

Pilot survey_media(Places& places) {
  constexpr std::size_t count = 64;
  const VolumeEstimator& estimator = find_volume_estimator("volume-triangulated");
  Pilot pilot{.known = true};
  for (const VolumePart part : parts)
    for (std::size_t i = 0; i < count; ++i)
      pilot.irradiance += static_cast<float>(mean_over_directions(places.jet(i, estimator, part)) / count);
  for (const VolumePart part : parts)
    for (std::size_t i = 0; i < count; ++i)
      pilot.error_rate += volume_error_rate(places.jet(i, estimator, part), pilot.irradiance) / (2 * count);
  return pilot;
}

std::optional<RecordCache> place_records(const Job& job, Places& places, std::size_t most) {
  RecordCache cache = empty_cache(job);
  VolumeCaches& caches = *cache.volumes();
  RayCounts counts;
  const LeakTest open{job.world, counts};
  bool placed = true;
  while (placed) {  // settling may uncover places that were covered
    placed = false;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const VolumePart part : parts) {
        const SeenPoint& point = places.point(i);
        VolumeCache& into = caches.of(part);
        if (into.covers({point.at.position, point.media}, places.bands(i), open)) continue;
        const VolumeJet& jet = places.jet(i, *job.method.volume.estimator, part);
        const std::uint32_t id =
            into.insert(job.method.make_volume_record(point.at.position, jet, point.media, view_of(job, point)));
        job.method.settle(into.settling(), {&id, 1});
        if (count_records(caches) > most) return std::nullopt;
        placed = true;
      }
  }
  for (const VolumePart part : parts) caches.of(part).reindex();
  return cache;
}

}  // namespace isophote::bench
