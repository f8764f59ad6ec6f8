#include "isophote/integrate/make_record.h"

#include <algorithm>
#include <limits>

#include "isophote/cache/radiance_cache.h"
#include "isophote/core/check.h"
#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/glossy_rule.h"
#include "isophote/integrate/jet_memo.h"
#include "isophote/integrate/leak_test.h"

namespace isophote {

namespace {

/// Does a camera sample see a point that may read what is cached?
bool reads_caches(const Job& job, const FirstPoint& seen) {
  if (!seen.point || seen.depth + 1 >= job.world.max_depth) return false;
  return seen.depth == 0 || job.world.max_depth == std::numeric_limits<int>::max();  // see shade()
}

Place at_point(const Job& job, const FirstPoint& seen, std::uint64_t key) {
  const SurfacePoint& p = *seen.point;
  const float pixel = job.pixel_footprint(seen.path_length);
  return {p.position, p.geometric_normal, p.shading_normal, pixel, p.offset, p.medium, key};
}

/// Where rays adapt, those that irradiance needs, times this a band: the more bands, the smaller the part of the
/// hemisphere from which their lobe takes light, and the more rays it takes to be as sure of it.
constexpr float rays_by_band = 0.4f;

Strata strata_for_bands(const Method& method, int rays, int bands) {
  if (method.adaptive)
    rays = std::min(most_rays, static_cast<int>(static_cast<float>(rays) * std::max(1.0f, rays_by_band * bands)));
  return Strata::about(std::max(rays, 3 * bands * bands / 2));  // which bands need to be told apart
}

}  // namespace

std::optional<Place> place_of(const Job& job, const FirstPoint& seen, std::uint64_t key) {
  if (!reads_caches(job, seen) || !seen.point->bsdf.has_diffuse()) return std::nullopt;
  return at_point(job, seen, key);
}

bool still_wants(const RecordCache& cache, Place& place, OpenTest open) {
  place.diffuse = place.diffuse && !cache.covers(query_at(place), open);
  if (!cache.radiance() || (place.bands > 0 && cache.radiance()->covers(query_at(place), place.bands, open)))
    place.bands = 0;
  return place.diffuse || place.bands > 0;
}

std::optional<Place> wanted_place(const Job& job, const FirstPoint& seen, std::uint64_t key) {
  if (!reads_caches(job, seen)) return std::nullopt;
  const Bsdf& bsdf = seen.point->bsdf;
  Place place = at_point(job, seen, key);
  place.diffuse = bsdf.has_diffuse();
  const CachedLobe lobe = cached_lobe(job.method.glossy, bsdf, -seen.direction);
  if (lobe.share > 0) place.bands = lobe.bands;
  if (!place.diffuse && place.bands == 0) return std::nullopt;
  return place;
}

std::optional<Place> uncovered_place(const Job& job, const RecordCache& cache, const FirstPoint& seen,
                                     std::uint64_t key, RayCounts& counts) {
  std::optional<Place> place = wanted_place(job, seen, key);
  if (!place || !still_wants(cache, *place, LeakTest{job.world, counts})) return std::nullopt;
  return place;
}

std::optional<SeenPlace> random_place(const Job& job, Sampler& stream, std::uint64_t key, RayCounts& counts) {
  const Vec2 at = stream.next2(), pixel{at.x * job.width, at.y * job.height};
  const Ray ray = job.camera.ray(pixel.x, pixel.y, job.width, job.height);
  const auto place = place_of(job, first_point(job.world.clear(), ray, true, stream, counts.camera), key);
  if (!place) return std::nullopt;
  return SeenPlace{*place, pixel};
}

View view_of(const Job& job, const Place& place) {
  return {place.pixel, place.pixel * static_cast<float>(job.height), job.world.rays.scene_scale(), place.normal,
          job.pilot};
}

namespace {

/// What gathers for records read where they hit.
FarLight far_light(const Job& job, const RecordCache& cache, IrradianceCells& left) {
  const Secondary secondary = job.method.secondary;
  if (secondary == Secondary::cells) return {nullptr, &cache.cells(), &left};
  if (secondary == Secondary::records) return {&cache, &cache.cells(), &left, &job.method.glossy};
  return {job.light};
}

void gather_at(const Job& job, const RecordCache& cache, const Place& place, Strata strata, HemisphereGather& scratch,
               IrradianceCells& left, RayCounts& counts) {
  const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::record), place.key);
  gather_hemisphere(job.world, far_light(job, cache, left), place, strata, key, scratch, counts);
}

}  // namespace

Jet<Rgb> jet_at(const Job& job, const RecordCache& cache, const Place& place, Strata strata, HemisphereGather& scratch,
                IrradianceCells& left, RayCounts& counts) {
  ISOPHOTE_CHECK(job.memo && (job.method.secondary != Secondary::off || job.method.adaptive), ==, false);
  const auto gather = [&]() -> const HemisphereGather& {
    gather_at(job, cache, place, strata, scratch, left, counts);
    return scratch;
  };
  const Estimator& estimator = *job.method.estimator;
  return job.memo ? job.memo->jet(estimator, place.key, gather) : estimator.estimate(gather());
}

NewRecords make_records(const Job& job, const RecordCache& cache, const Place& place, HemisphereGather& scratch,
                        IrradianceCells& left, RayCounts& counts) {
  const Method& method = job.method;
  const View view = view_of(job, place);
  const Strata strata = method.adaptive ? strata_near(job, cache, place) : job.strata;
  NewRecords made;
  if (place.bands == 0) {
    const Jet<Rgb> jet = jet_at(job, cache, place, strata, scratch, left, counts);
    made.irradiance = method.make_record(place.position, place.normal, jet, view);
    return made;
  }
  gather_at(job, cache, place, strata_for_bands(method, strata.size(), place.bands), scratch, left, counts);
  if (place.diffuse) made.irradiance = method.make_record(scratch, view);
  made.radiance = method.make_radiance_record(scratch, place.bands, view);
  return made;
}

FreshIds add_records(const Method& method, RecordCache& cache, std::vector<NewRecords> made) {
  FreshIds fresh;
  for (NewRecords& records : made) {
    if (records.irradiance) fresh.irradiance.push_back(cache.insert(std::move(*records.irradiance)));
    if (records.radiance) fresh.radiance.push_back(cache.radiance()->insert(std::move(*records.radiance)));
  }
  method.settle(cache.settling(), fresh.irradiance);
  if (!fresh.radiance.empty()) method.settle(cache.radiance()->settling(), fresh.radiance);
  return fresh;
}

}  // namespace isophote
