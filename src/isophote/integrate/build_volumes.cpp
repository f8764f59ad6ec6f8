#include "isophote/integrate/build_volumes.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/gather.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/over_pixels.h"
#include "isophote/integrate/pick_spread.h"

namespace isophote {
namespace {

constexpr VolumePart parts[] = {VolumePart::surfaces, VolumePart::media};

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
  while (!candidates.empty() && !job_.progress.stop()) {
    add_round(pick_spread(candidates, near), rays);
    std::vector<char> wants(candidates.size());
    rays += for_each(job_.parallel, candidates.size(), 64, [&](std::size_t i, RayCounts& counts) {
      wants[i] = still_wants(candidates[i], counts);
      if (wants[i]) meet_records(candidates[i]);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (wants[i]) candidates[kept++] = candidates[i];
    candidates.resize(kept);
    ++rounds_;
  }
  return all;
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
    bool& wants = c.wants[static_cast<int>(part)];
    wants = wants && !cache_.volumes()->of(part).covers({c.position, c.media}, c.bands, open);
  }
  return c.wants[0] || c.wants[1];
}

void VolumeBuilder::meet_records(Candidate& c) const {
  for (const VolumePart part : parts) {
    if (!c.wants[static_cast<int>(part)]) continue;
    cache_.volumes()->of(part).visit_near(c.position, [&](const VolumeRecord& record) {
      const float distance = quadratic_form(record.footprint.shape, c.position - record.position);
      if (record.media == c.media && distance < c.nearest) c.nearest = distance, c.reach = record.footprint.radius;
    });
  }
}

void VolumeBuilder::add_round(const std::vector<Candidate>& picked, RayCounts& rays) {
  std::vector<std::array<std::optional<VolumeRecord>, 2>> made(picked.size());
  const FarLight from{&cache_, nullptr, nullptr, &job_.method.glossy};
  rays += for_each(job_.parallel, picked.size(), 1, [&](std::size_t i, RayCounts& counts) {
    thread_local SphereGather gather;
    const Candidate& c = picked[i];
    gather_sphere(job_.world, from, c.position, {}, sphere_strata(job_.strata.size(), c.bands), c.key, gather, counts);
    View view;
    view.pixel = c.pixel;
    view.picture = c.pixel * static_cast<float>(job_.height);
    view.scene_scale = job_.world.rays.scene_scale();
    for (const VolumePart part : parts)
      if (c.wants[static_cast<int>(part)])
        made[i][static_cast<int>(part)] = job_.method.make_volume_record(gather, part, c.media, c.bands, view);
  });
  for (const VolumePart part : parts) {
    std::vector<std::uint32_t> fresh;
    VolumeCache& cache = cache_.volumes()->of(part);
    for (auto& records : made)
      if (auto& record = records[static_cast<int>(part)]) fresh.push_back(cache.insert(std::move(*record)));
    job_.method.settle(cache.settling(), fresh);
  }
}

}  // namespace isophote
