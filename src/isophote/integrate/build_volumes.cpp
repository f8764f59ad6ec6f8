#include "isophote/integrate/build_volumes.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/over_pixels.h"
#include "isophote/integrate/pick_spread.h"
#include "isophote/integrate/pilot.h"
#include "isophote/validity/volume_error.h"

namespace isophote {
namespace {

constexpr VolumePart parts[] = {VolumePart::surfaces, VolumePart::media};
constexpr std::size_t index(VolumePart part) { return static_cast<std::size_t>(part); }

/// About as many rays as there are bands to tell apart, or as the job has for surfaces.
SphereStrata sphere_strata(int rays, int bands) {
  const int polar = std::max(4, static_cast<int>(std::lround(std::sqrt(std::max(rays, 3 * bands * bands) / 2.0))));
  return {polar, 2 * polar};
}

}  // namespace

std::size_t VolumeBuilder::cover(int stride, int sample, RayCounts& rays) {
  if (!cache_.volumes() || !job_.world.media) return 0;
  std::vector<Candidate> candidates = uncovered(stride, sample, rays);
  const std::size_t all = candidates.size();
  const auto near = [](const Candidate& a, const Candidate& b) {
    const float reach = std::max(a.reach, b.reach);
    return length_squared(a.position - b.position) < reach * reach && a.media == b.media;
  };
  if (survey(candidates, rays)) leave_wanting(candidates, rays);
  while (!candidates.empty()) {
    cancelled_ = job_.progress.stop();
    if (cancelled_) break;
    const std::vector<Candidate> picked = pick_spread(candidates, near);
    std::vector<Jets> jets = jets_at(picked, rays);
    add(picked, jets);
    leave_wanting(candidates, rays);
    ++rounds_;
  }
  return all;
}

void VolumeBuilder::leave_wanting(std::vector<Candidate>& candidates, RayCounts& rays) const {
  std::vector<char> wants(candidates.size());
  rays += for_each(job_.parallel, candidates.size(), 64, [&](std::size_t i, RayCounts& counts) {
    wants[i] = still_wants(candidates[i], counts);
    if (wants[i]) meet_records(candidates[i]);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (wants[i]) candidates[kept++] = candidates[i];
  candidates.resize(kept);
}

void VolumeBuilder::finish() {
  if (!cache_.volumes()) return;
  for (const VolumePart part : parts) cache_.volumes()->of(part).reindex();
}

std::vector<VolumeBuilder::Candidate> VolumeBuilder::uncovered(int stride, int sample, RayCounts& rays) const {
  const Media& media = *job_.world.media;
  const auto look = [&](int x, int y, std::vector<Candidate>& found, RayCounts& counts) {
    Sampler stream = job_.sampler(x, y, sample);
    const Ray ray = job_.camera_ray(x, y, stream);
    Hit hit;
    ++counts.camera;
    job_.world.rays.intersect(ray, stream.next_bits(), hit);
    for (const Media::RayPoint& at : media.sample_points({ray.origin, ray.direction, 0, hit.distance}, 1, stream)) {
      if (is_black(at.scattering)) continue;
      const std::uint32_t held = media.holding(at.point.position);
      Candidate c{at.point.position, held, job_.pixel_footprint(at.distance), hash(job_.seed, x, y, sample, 1)};
      c.bands = bands_for(media.anisotropy(held));
      c.wants[0] = c.wants[1] = true;
      if (!still_wants(c, counts)) continue;
      meet_records(c);
      found.push_back(c);
    }
  };
  auto all = collect_over_pixels<Candidate>(job_, stride, rays, look);
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.key < b.key; });
  return all;
}

bool VolumeBuilder::still_wants(Candidate& c, RayCounts& counts) const {
  const LeakTest open{job_.world, counts};
  for (const VolumePart part : parts) {
    bool& wants = c.wants[index(part)];
    wants = wants && !cache_.volumes()->of(part).covers({c.position, c.media}, c.bands, open);
  }
  return c.wants[0] || c.wants[1];
}

void VolumeBuilder::meet_records(Candidate& c) const {
  for (const VolumePart part : parts) {
    if (!c.wants[index(part)]) continue;
    cache_.volumes()->of(part).visit_near(c.position, [&](const VolumeRecord& record) {
      const float distance = quadratic_form(record.footprint.shape, c.position - record.position);
      if (record.media == c.media && distance < c.nearest) c.nearest = distance, c.reach = record.footprint.radius;
    });
  }
}

std::vector<VolumeBuilder::Jets> VolumeBuilder::jets_at(std::span<const Candidate> places, RayCounts& rays) const {
  std::vector<Jets> jets(places.size());
  const FarLight from{&cache_, nullptr, nullptr, &job_.method.glossy};
  rays += for_each(job_.parallel, places.size(), 1, [&](std::size_t i, RayCounts& counts) {
    thread_local SphereGather gather;
    const Candidate& c = places[i];
    gather_sphere(job_.world, from, c.position, {}, sphere_strata(job_.strata.size(), c.bands), c.key, gather, counts);
    for (const VolumePart part : parts)
      if (c.wants[index(part)]) jets[i][index(part)] = job_.method.volume.estimator->estimate(gather, part, c.bands);
  });
  return jets;
}

void VolumeBuilder::add(std::span<const Candidate> places, std::span<Jets> jets) {
  for (const VolumePart part : parts) {
    std::vector<std::uint32_t> fresh;
    VolumeCache& cache = cache_.volumes()->of(part);
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::optional<VolumeJet>& jet = jets[i][index(part)];
      const Candidate& c = places[i];
      if (!jet || !c.wants[index(part)]) continue;
      View view;
      view.pixel = c.pixel;
      view.picture = c.pixel * static_cast<float>(job_.height);
      view.scene_scale = std::max(job_.world.rays.scene_scale(), job_.world.media->bounds().diagonal());
      view.pilot = pilot_;
      fresh.push_back(cache.insert(job_.method.make_volume_record(c.position, std::move(*jet), c.media, view)));
    }
    job_.method.settle(cache.settling(), fresh);
  }
}

bool VolumeBuilder::survey(std::span<Candidate> candidates, RayCounts& rays) {
  if (job_.method.volume.metric->needs < 2 || pilot_.known || candidates.empty()) return false;
  const std::span<Candidate> places = candidates.first(std::min(candidates.size(), surveyed_places));
  std::vector<Jets> jets = jets_at(places, rays);
  // Both parts add up to one picture: they share its mean and the error that is allowed.
  const auto mean_of = [&](const auto& value) {
    double sum = 0;
    for (const Jets& each : jets)
      for (const auto& jet : each)
        if (jet) sum += static_cast<double>(value(*jet));
    return static_cast<float>(sum / static_cast<double>(jets.size()));
  };
  const float mean = mean_of(mean_over_directions);
  const float rate = mean_of([&](const VolumeJet& jet) { return volume_error_rate(jet, mean); });
  pilot_ = {true, rate / static_cast<float>(std::size(parts)), mean};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (still_wants(places[i], rays)) add(places.subspan(i, 1), std::span(jets).subspan(i, 1));
  return true;
}

}  // namespace isophote
