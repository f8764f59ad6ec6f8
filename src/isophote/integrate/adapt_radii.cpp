#include "isophote/integrate/adapt_radii.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "isophote/integrate/glossy_lobes.h"
#include "isophote/integrate/glossy_rule.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/over_pixels.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

/// What a record is to shrink to, of its radius.
struct Limit {
  std::uint32_t id;
  float part;
};

/// A record that serves a place, and the part of its radius with which it just would.
struct Overlap {
  Limit rim;
  float weight, reflected;
};

/// Of an error, the part by the way from the record grows as the radius shrinks, that by the turn of the normal does
/// not.
float part_to_rim(const Site& record, const Vec3& position, float error) {
  const float away = std::sqrt(quadratic_form(record.footprint.shape, position - record.position));
  return record.footprint.falloff == Falloff::tabellion ? away : away / (1 - std::max(0.0f, error - away));
}

/// Adds to `limits` those of the records at one place that differ from the one that weighs most.
void compare(const std::vector<Overlap>& here, float contrast, std::vector<Limit>& limits) {
  if (here.size() < 2) return;
  const Overlap& best =
      *std::max_element(here.begin(), here.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
  for (const Overlap& o : here)
    if (std::abs(o.reflected - best.reflected) > contrast * std::max(o.reflected, best.reflected))
      limits.push_back({o.rim.id, std::max(o.rim.part, 0.5f)});
}

void compare_at(const Job& job, const RadianceCache& cache, const FirstPoint& seen, std::vector<Overlap>& here,
                std::vector<Limit>& limits, RayCounts& counts) {
  const SurfacePoint& point = *seen.point;
  const Vec3 wo = -seen.direction;
  const GlossyMethod& method = job.method.glossy;
  const CachedLobe cached = cached_lobe(method, point.bsdf, wo);
  if (!(cached.share > 0)) return;
  const SurfaceLobe lobe(glossy_lobes(cache.basis()), point.bsdf, wo, method.window);
  here.clear();
  cache.visit_reflected(query_at(point), wo, cached.bands, lobe, LeakTest{job.world, counts},
                        [&](std::uint32_t id, float error, float weight, const Rgb& reflected) {
                          const float part = part_to_rim(cache.records()[id], point.position, error);
                          here.push_back({{id, part}, weight, std::max(0.0f, luminance(reflected))});
                        });
  compare(here, method.contrast, limits);
}

}  // namespace

void adapt_radii(const Job& job, RadianceCache& cache, int stride, int sample, RayCounts& counts) {
  const auto look = [&](int x, int y, std::vector<Limit>& limits, RayCounts& mine) {
    thread_local std::vector<Overlap> here;
    Sampler stream = job.sampler(x, y, sample);
    const FirstPoint seen = first_point(job.world.clear(), job.camera_ray(x, y, stream), true, stream, mine.camera);
    if (seen.point) compare_at(job, cache, seen, here, limits, mine);
  };
  const auto limits = collect_over_pixels<Limit>(job, stride, counts, look);
  // Whatever the order, the least limit of a record is the one that counts.
  std::vector<float> least(cache.records().size(), 1.0f);
  for (const Limit& limit : limits) least[limit.id] = std::min(least[limit.id], limit.part);
  for (std::uint32_t id = 0; id < least.size(); ++id)
    if (least[id] < 1) cache.shrink(id, least[id]);
}

}  // namespace isophote
