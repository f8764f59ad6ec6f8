#include "isophote/cache/record_cache.h"

#include <cmath>

#include "isophote/core/ray.h"

namespace isophote {
namespace {

/// A record is in front of a query (it may see what the query cannot, and the other way round) where the query lies
/// under the plane of the mean normal by more than this part of the record's radius. On a convex or concave sphere the
/// mean plane holds both points, so neighbours serve each other.
constexpr float in_front = 0.05f;

}  // namespace

float footprint_error(const Record& record, const Vec3& position, const Vec3& normal) {
  const Vec3 q = position - record.position;
  const float distance = quadratic_form(record.footprint.shape, q);
  if (!(distance < 1)) return infinity;
  if (dot(normal, record.normal) <= 0) return infinity;
  if (dot(q, normal + record.normal) < -2 * in_front * record.footprint.radius) return infinity;
  // Of the difference, not of 1 - cosine, which rounding keeps from being 0 where the normals are equal.
  const float away = std::sqrt(distance),
              turned = record.footprint.normal_scale * std::sqrt(length_squared(normal - record.normal) / 2);
  return record.footprint.falloff == Falloff::tabellion ? std::max(away, turned) : away + turned;
}

float falloff_weight(Falloff falloff, float error) {
  return falloff == Falloff::ward ? 1 / std::max(error, 1e-6f) - 1 : 1 - error;
}

std::uint32_t RecordCache::insert(const Record& record) {
  const auto id = static_cast<std::uint32_t>(records_.size());
  records_.push_back(record);
  octree_.insert(id, record.position, record.footprint.radius);
  return id;
}

void RecordCache::reindex() {
  octree_ = Octree(bounds_);
  for (std::uint32_t id = 0; id < records_.size(); ++id)
    octree_.insert(id, records_[id].position, records_[id].footprint.radius);
}

std::optional<Rgb> RecordCache::interpolate(const Query& query) const {
  Rgb sum;
  float weights = 0;
  visit_near(query.position, [&](const Record& record) {
    const float error = footprint_error(record, query.position, query.normal);
    if (!(error < 1)) return;
    const float weight = falloff_weight(record.footprint.falloff, error);
    sum += record.extrapolate(query.position - record.position, query.facing) * weight;
    weights += weight;
  });
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

bool RecordCache::covers(const Query& query) const {
  return octree_.any(query.position,
                     [&](std::uint32_t id) { return footprint_error(records_[id], query.position, query.normal) < 1; });
}

}  // namespace isophote
