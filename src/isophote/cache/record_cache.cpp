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
  return std::sqrt(distance) + record.footprint.normal_scale * std::sqrt(length_squared(normal - record.normal) / 2);
}

float serving_error(const Record& record, const Query& query, OpenTest open) {
  const float error = footprint_error(record, query.position, query.normal);
  if (!(error < 1)) return error;
  const bool unsure = record.jet.distances.obstacles.before(query.position - record.position, record.normal);
  return unsure && !open(record, query) ? infinity : error;
}

float falloff_weight(Falloff falloff, float error) {
  return falloff == Falloff::tent ? 1 - error : 1 / std::max(error, 1e-6f) - 1;
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

std::optional<Rgb> RecordCache::interpolate(const Query& query, OpenTest open) const {
  Rgb sum;
  float weights = 0;
  visit_near(query.position, [&](const Record& record) {
    const float error = serving_error(record, query, open);
    if (!(error < 1)) return;
    const float weight = falloff_weight(record.footprint.falloff, error);
    sum += record.extrapolate(query.position - record.position, query.facing) * weight;
    weights += weight;
  });
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

bool RecordCache::covers(const Query& query, OpenTest open) const {
  return octree_.any(query.position, [&](std::uint32_t id) { return serving_error(records_[id], query, open) < 1; });
}

}  // namespace isophote
