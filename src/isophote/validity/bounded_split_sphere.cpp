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

/// Of a raised radius, what its height over and under the surface keeps at least: enough for uneven ground.
constexpr float least_height = 0.25f;

/// Where a lower bound has raised the radius above what the metric alone would give, the record reaches further along
/// its surface only: what lies above, on a step or a table, may be lit quite otherwise.
void settle_raised(Record& record, float a) {
  const float natural = split_sphere_radius(record.footprint.unscaled, a), radius = record.footprint.radius;
  limit_gradient(record, natural);
  if (natural < radius) record.footprint.flatten(record.normal, std::max(natural, least_height * radius));
}

void shrink(Record& record, float unscaled, float a) {
  record.footprint.unscaled = unscaled;
  record.footprint.resize(split_sphere_radius(unscaled, a));
}

/// A fresh record takes its own limit from all its neighbours first, and then limits them: among records that face
/// alike the outcome is the largest radii that keep the bound, whatever the order.
void clamp_to_neighbours(const Settling& settling, std::uint32_t fresh, float a) {
  const auto& [records, neighbours] = settling;
  Record& record = records[fresh];
  const float unscaled = record.footprint.unscaled;
  if (const float limit = neighbours.limit(records, record.position, record.normal, unscaled); limit < unscaled)
    shrink(record, limit, a);
  neighbours.insert(records);
  for (const std::uint32_t id : neighbours.limited(records, record)) {
    shrink(records[id], record.footprint.unscaled + length(records[id].position - record.position), a);
    settle_raised(records[id], a);
    neighbours.lowered(records, id);
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

void settle_bounded(const Settling& settling, std::span<const std::uint32_t> fresh, float a,
                    const RadiusBounds& bounds) {
  for (const std::uint32_t id : fresh) {
    if (bounds.neighbours) {
      while (settling.neighbours.size() < id) settling.neighbours.insert(settling.records);
      clamp_to_neighbours(settling, id, a);
    }
    settle_raised(settling.records[id], a);
  }
}

}  // namespace isophote
