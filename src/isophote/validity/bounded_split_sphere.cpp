#include "isophote/validity/bounded_split_sphere.h"

#include <algorithm>
#include <cmath>

#include "isophote/validity/limit_gradient.h"
#include "isophote/validity/split_sphere.h"

namespace isophote {
namespace {

/// E / |grad E| for the channel in which it is least; infinity where nothing changes.
float gradient_radius(const Jet<Rgb>& jet) {
  float radius = std::numeric_limits<float>::infinity();
  for (int c = 0; c < 3; ++c) {
    const Vec3 g{jet.translational.x[c], jet.translational.y[c], jet.translational.z[c]};
    const float steepness = length(g);
    if (steepness > 0) radius = std::min(radius, jet.value[c] / steepness);
  }
  return radius;
}

/// What the limit on extrapolation needs to know is the radius that the metric alone would give.
void settle_gradient(Record& record, float a) {
  limit_gradient(record, split_sphere_radius(record.footprint.unscaled, a));
}

void shrink(Record& record, float unscaled, float a) {
  record.footprint.unscaled = unscaled;
  record.footprint.resize(split_sphere_radius(unscaled, a));
}

/// What one record lets another that faces alike have: no more than its own radius and their distance. Infinite where
/// it sets no limit under `unscaled`, which is told without a root.
float limit_by(const Record& neighbour, const Vec3& position, const Vec3& normal, float unscaled) {
  const float room = unscaled - neighbour.footprint.unscaled;
  const Vec3 between = position - neighbour.position;
  if (!(room > 0) || length_squared(between) >= room * room || dot(normal, neighbour.normal) <= 0)
    return std::numeric_limits<float>::infinity();
  return neighbour.footprint.unscaled + length(between);
}

/// Lets `neighbour` limit `record`.
void clamp(Record& record, const Record& neighbour, float a) {
  const float limit = limit_by(neighbour, record.position, record.normal, record.footprint.unscaled);
  if (limit < record.footprint.unscaled) shrink(record, limit, a);
}

/// A fresh record takes its own limit from all its neighbours first, and then limits them: among records that face alike
/// the outcome is the largest radii that keep the bound, whatever the order. Each pass over the earlier records, of
/// which there may be many, serves all the fresh ones, of which there are few.
void clamp_to_neighbours(std::span<Record> earlier, std::span<Record> fresh, float a) {
  for (const Record& other : earlier)
    for (Record& record : fresh) clamp(record, other, a);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) clamp(fresh[i], fresh[k], a);
    for (std::size_t k = 0; k < i; ++k) clamp(fresh[k], fresh[i], a);
  }
  for (Record& other : earlier) {
    const float before = other.footprint.unscaled;
    for (const Record& record : fresh) clamp(other, record, a);
    if (other.footprint.unscaled < before) settle_gradient(other, a);
  }
}

}  // namespace

Footprint bounded_split_sphere(const Jet<Rgb>& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = std::min(jet.distances.harmonic_mean, view.scene_scale);
  if (bounds.gradient) unscaled = std::min(unscaled, gradient_radius(jet));
  const float pixel_limit = std::isinf(bounds.max_pixels) ? bounds.max_pixels : bounds.max_pixels * view.pixel;
  const float upper = std::min({bounds.max_length, pixel_limit, view.scene_scale});
  const float wanted = std::max(bounds.min_length, bounds.min_view * a * view.picture);
  const float lower =
      std::max({std::min(wanted, pixel_limit), bounds.min_pixels * view.pixel, smallest_radius * view.scene_scale});
  const float largest = std::max(lower, upper);
  Footprint footprint = Footprint::disk(largest, 1 / a);
  footprint.unscaled = unscaled;
  footprint.smallest = lower;
  footprint.largest = largest;
  footprint.resize(split_sphere_radius(unscaled, a));
  footprint.falloff = Falloff::tent;
  return footprint;
}

void settle_bounded(std::span<Record> records, std::span<const std::uint32_t> fresh, float a,
                    const RadiusBounds& bounds) {
  if (bounds.neighbours && !fresh.empty())
    clamp_to_neighbours(records.first(fresh.front()), records.subspan(fresh.front(), fresh.size()), a);
  for (const std::uint32_t i : fresh) settle_gradient(records[i], a);
}

}  // namespace isophote
