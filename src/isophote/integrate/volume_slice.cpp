#include "isophote/integrate/volume_slice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "isophote/cache/volume_cache.h"
#include "isophote/core/frame.h"
#include "isophote/integrate/in_scattering.h"

namespace isophote {
namespace {

constexpr float line_width = 1.2f;  // pixels, of rims
constexpr float dash_period = 7;    // pixels

using Colour = std::function<Rgb(const VolumeRecord&)>;

/// Does a dash lie at `p`? They turn about the record within the plane of `frame`, as many as fit its equator.
bool on_dash(const VolumeRecord& record, const Vec3& p, const Frame& frame, float pixel) {
  const Vec3 q = frame.to_local(p - record.position);
  const float dashes = std::max(4.0f, std::round(2 * pi * record.footprint.radius / (dash_period * pixel)));
  const float turn = dashes * (0.5f + std::atan2(q.y, q.x) / (2 * pi));
  return turn - std::floor(turn) < 0.5f;
}

/// What is drawn at one place of a slice, which `media` hold.
struct Rims {
  const Job& job;
  const RecordCache& cache;
  const Colour& colour;
  const Sight& sight;
  std::uint32_t media;

  /// Lines lie within the rims, where a record is sure to be visited.
  std::optional<Rgb> of(VolumePart part) const {
    const Vec3& p = sight.place.position;
    const Frame frame(sight.place.geometric_normal);
    std::optional<Rgb> drawn;
    cache.volumes()->of(part).visit_near(p, [&](const VolumeRecord& record) {
      if (record.media != media) return;
      const float inside = on_screen(record, sight).inside_rim;
      if (!(inside >= 0 && inside < line_width)) return;
      const float pixel = job.pixel_footprint(length(record.position - job.camera.eye));
      if (part == VolumePart::media || on_dash(record, p, frame, pixel)) drawn = colour(record);
    });
    return drawn;
  }
};

}  // namespace

std::optional<Plane> plane_amid_records(const Job& job, const RecordCache& cache) {
  if (!cache.volumes()) return std::nullopt;
  const Camera& camera = job.camera;
  float nearest = infinity, farthest = -infinity;
  for (const VolumeCache* part : {&cache.volumes()->surfaces, &cache.volumes()->media})
    for (const VolumeRecord& record : part->records()) {
      const float depth = dot(record.position - camera.eye, camera.forward);
      nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
    }
  if (!(nearest <= farthest)) return std::nullopt;
  return Plane{camera.eye + camera.forward * (0.5f * (nearest + farthest)), camera.forward};
}

Screen volume_slice(const Job& job, const RecordCache& cache, const Plane& plane, Colour colour) {
  return [&job, &cache, plane, colour = std::move(colour)](const Ray& ray, float surface,
                                                           RayCounts& counts) -> std::optional<Shown> {
    const Media& media = *job.world.media;
    const float distance = dot(plane.point - ray.origin, plane.normal) / dot(ray.direction, plane.normal);
    if (!(distance > 0 && distance < surface)) return std::nullopt;
    const Vec3 p = ray.origin + ray.direction * distance;
    if (is_black(media.extinction(p))) return std::nullopt;
    Sight sight{{}, ray.direction, job.pixel_footprint(distance)};
    sight.place.position = p, sight.place.geometric_normal = plane.normal;
    const Rims rims{job, cache, colour, sight, media.holding(p)};
    auto mark = rims.of(VolumePart::media);
    if (!mark) mark = rims.of(VolumePart::surfaces);
    if (mark) return Shown{mark, {}};
    MediumPoint even;  // of a phase function that takes the mean over all directions
    even.position = p;
    auto light = cached_in_scattering(job.world, {&cache, nullptr, nullptr, nullptr}, even, ray.direction, counts);
    if (light) *light *= pi;
    return Shown{{}, light};
  };
}

}  // namespace isophote
