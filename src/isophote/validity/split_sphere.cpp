#include "isophote/validity/split_sphere.h"

#include <algorithm>
#include <numbers>

namespace isophote {

float split_sphere_radius(float harmonic_mean, float a) { return harmonic_mean * a * (std::numbers::pi_v<float> / 4); }

Footprint split_sphere(const DistanceStats& distances, const View& view, float a) {
  const float r = std::min(distances.harmonic_mean, view.scene_scale);
  const float smallest = smallest_radius * view.scene_scale;
  Footprint footprint = Footprint::disk(std::max(split_sphere_radius(r, a), smallest), 1 / a);
  footprint.unscaled = r;
  footprint.smallest = smallest;
  return footprint;
}

}  // namespace isophote
