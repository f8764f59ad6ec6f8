#include "isophote/validity/bounded_split_sphere.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

Footprint bounded_split_sphere(const Jet<Rgb>& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = std::min(jet.distances.harmonic_mean, view.scene_scale);
  if (bounds.gradient) unscaled = std::min(unscaled, gradient_radius(jet));
  const RadiusRange range(bounds, view, a);
  Footprint footprint = Footprint::disk(range.largest, 1 / a);
  footprint.unscaled = unscaled;
  footprint.smallest = range.smallest;
  footprint.largest = range.largest;
  footprint.resize(split_sphere_radius(unscaled, a));
  footprint.falloff = Falloff::tent;
  return footprint;
}

}  // namespace isophote
