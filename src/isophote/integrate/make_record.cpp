#include "isophote/integrate/make_record.h"

#include <limits>

#include "isophote/core/check.h"
#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/jet_memo.h"

namespace isophote {

std::optional<Place> place_of(const Job& job, const FirstPoint& seen, std::uint64_t key) {
  if (!seen.point || !seen.point->bsdf.has_diffuse() || seen.depth + 1 >= job.world.max_depth) return std::nullopt;
  if (seen.depth > 0 && job.world.max_depth < std::numeric_limits<int>::max()) return std::nullopt;  // see shade()
  const SurfacePoint& p = *seen.point;
  const float pixel = job.pixel_footprint(seen.path_length);
  return Place{p.position, p.geometric_normal, p.shading_normal, pixel, p.offset, p.medium, key};
}

std::optional<SeenPlace> random_place(const Job& job, Sampler& stream, std::uint64_t key, RayCounts& counts) {
  const Vec2 at = stream.next2(), pixel{at.x * job.width, at.y * job.height};
  const Ray ray = job.camera.ray(pixel.x, pixel.y, job.width, job.height);
  const auto place = place_of(job, first_point(job.world, ray, true, stream, counts.camera), key);
  if (!place) return std::nullopt;
  return SeenPlace{*place, pixel};
}

View view_of(const Job& job, const Place& place) {
  return {place.pixel, place.pixel * static_cast<float>(job.height), job.world.rays.scene_scale(), place.normal,
          job.pilot};
}

Jet<Rgb> jet_at(const Job& job, const RecordCache& cache, const Place& place, Strata strata, HemisphereGather& scratch,
                IrradianceCells& left, RayCounts& counts) {
  const Secondary secondary = job.method.secondary;
  ISOPHOTE_CHECK(job.memo && (secondary != Secondary::off || job.method.adaptive), ==, false);
  FarLight from{job.light};
  if (secondary == Secondary::cells) from = {nullptr, &cache.cells(), &left};
  if (secondary == Secondary::records) from = {&cache, &cache.cells(), &left};
  const auto gather = [&]() -> const HemisphereGather& {
    const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::record), place.key);
    gather_hemisphere(job.world, from, place, strata, key, scratch, counts);
    return scratch;
  };
  const Estimator& estimator = *job.method.estimator;
  return job.memo ? job.memo->jet(estimator, place.key, gather) : estimator.estimate(gather());
}

Record make_record(const Job& job, const RecordCache& cache, const Place& place, HemisphereGather& scratch,
                   IrradianceCells& left, RayCounts& counts) {
  const Strata strata = job.method.adaptive ? strata_near(job, cache, place) : job.strata;
  const Jet<Rgb> jet = jet_at(job, cache, place, strata, scratch, left, counts);
  return job.method.make_record(place.position, place.normal, jet, view_of(job, place));
}

}  // namespace isophote
