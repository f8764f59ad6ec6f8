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

void clamp_to_neighbours(std::span<Record> earlier, Record& record, float a) {
  const auto shrink = [a](Record& r, float unscaled) {
    r.footprint.unscaled = unscaled;
    r.footprint.resize(split_sphere_radius(unscaled, a));
  };
  for (Record& other : earlier) {
    const float distance = length(record.position - other.position);
    const float mine = record.footprint.unscaled, theirs = other.footprint.unscaled;
    if (distance >= std::abs(mine - theirs) || dot(record.normal, other.normal) <= 0) continue;
    if (mine > theirs) {
      shrink(record, theirs + distance);
    } else {
      shrink(other, mine + distance);
      settle_gradient(other, a);
    }
  }
}

}  // namespace

Footprint bounded_split_sphere(const Jet<Rgb>& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = std::min(jet.distances.harmonic_mean, view.scene_scale);
  if (bounds.gradient) unscaled = std::min(unscaled, gradient_radius(jet));
  const float pixel_limit = bounds.max_pixels * view.pixel;
  const float upper = std::min({bounds.max_length, pixel_limit, view.scene_scale});
  const float lower = std::max({std::min(bounds.min_length, pixel_limit), bounds.min_pixels * view.pixel,
                                smallest_radius * view.scene_scale});
  Footprint footprint = Footprint::disk(upper, 1 / a);
  footprint.unscaled = unscaled;
  footprint.smallest = lower;
  footprint.largest = std::max(lower, upper);
  footprint.resize(split_sphere_radius(unscaled, a));
  footprint.falloff = Falloff::tent;
  return footprint;
}

void settle_bounded(std::span<Record> records, std::span<const std::uint32_t> fresh, float a, const RadiusBounds& bounds) {
  for (const std::uint32_t i : fresh) {
    if (bounds.neighbours) clamp_to_neighbours(records.first(i), records[i], a);
    settle_gradient(records[i], a);
  }
}

}  // namespace isophote
