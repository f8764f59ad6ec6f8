#include "isophote/cache/record_cache.h"

#include <cmath>

#include "isophote/core/ray.h"

namespace isophote {
namespace {

/// A record is in front of a query (it may see what the query cannot, and the other way round) where the query lies
/// under the plane of the mean normal by more than this part of the record's radius. On a convex or concave sphere the
/// mean plane holds both points, so neighbours serve each other.
constexpr float in_front = 0.05f;

bool faces_away(const Site& record, const Vec3& normal) { return dot(normal, record.normal) <= 0; }

bool lies_in_front(const Site& record, const Vec3& q, const Vec3& normal) {
  return dot(q, normal + record.normal) < -2 * in_front * record.footprint.radius;
}

}  // namespace

float footprint_error(const Site& record, const Vec3& position, const Vec3& normal) {
  const Vec3 q = position - record.position;
  const float distance = quadratic_form(record.footprint.shape, q);
  if (!(distance < 1)) return infinity;
  if (faces_away(record, normal) || lies_in_front(record, q, normal)) return infinity;
  // Of the difference, not of 1 - cosine, which rounding keeps from being 0 where the normals are equal.
  const float away = std::sqrt(distance),
              turned = record.footprint.normal_scale * std::sqrt(length_squared(normal - record.normal) / 2);
  return record.footprint.combine(away, turned);
}

Standing standing(const Record& record, const Query& query, OpenTest open) {
  const Vec3 q = query.position - record.position;
  if (!(quadratic_form(record.footprint.shape, q) < 1)) return Standing::beyond_rim;
  if (faces_away(record, query.normal)) return Standing::facing_away;
  if (lies_in_front(record, q, query.normal)) return Standing::in_front;
  if (!(footprint_error(record, query.position, query.normal) < 1)) return Standing::turned;
  return serving_error(record, query, open) < 1 ? Standing::serves : Standing::blocked;
}

float falloff_weight(Falloff falloff, float error) {
  if (falloff == Falloff::ward) return 1 / std::max(error, 1e-6f) - 1;
  const float inwards = 1 - error;
  return falloff == Falloff::smooth ? inwards * inwards * (3 - 2 * inwards) : inwards;
}

std::optional<Rgb> RecordCache::interpolate(const Query& query, OpenTest open) const {
  Rgb sum;
  float weights = 0;
  visit_serving(query, open, [&](std::uint32_t id, float, float weight) {
    const Record& record = records()[id];
    sum += record.extrapolate(query.position - record.position, query.facing) * weight;
    weights += weight;
  });
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

}  // namespace isophote
