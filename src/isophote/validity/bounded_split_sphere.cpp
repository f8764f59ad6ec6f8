#include "isophote/validity/bounded_split_sphere.h"

#include <algorithm>
#include <cmath>

#include "isophote/validity/limit_gradient.h"
#include "isophote/validity/split_sphere.h"

namespace isophote {
namespace {

/// Of the scene's diagonal: what is left of a radius where everything would shrink it to nothing, as in a black corner.
constexpr float smallest_radius = 1e-5f;

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

/// The record takes its own limit from all its neighbours first, and then limits them: among records that face alike
/// the outcome is the largest radii that keep the bound, whatever the order.
void clamp_to_neighbours(std::span<Record> earlier, Record& record, float a) {
  const auto alike = [&](const Record& other) { return dot(record.normal, other.normal) > 0; };
  float unscaled = record.footprint.unscaled;
  for (const Record& other : earlier)
    if (alike(other))
      unscaled = std::min(unscaled, other.footprint.unscaled + length(record.position - other.position));
  if (unscaled < record.footprint.unscaled) shrink(record, unscaled, a);
  for (Record& other : earlier) {
    const float limit = unscaled + length(record.position - other.position);
    if (limit >= other.footprint.unscaled || !alike(other)) continue;
    shrink(other, limit, a);
    settle_gradient(other, a);
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
  for (const std::uint32_t i : fresh) {
    if (bounds.neighbours) clamp_to_neighbours(records.first(i), records[i], a);
    settle_gradient(records[i], a);
  }
}

}  // namespace isophote
