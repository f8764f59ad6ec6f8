#pragma once

#include "isophote/derivatives/volume_sum.h"

namespace isophote {

/// Radiance in a medium with its gradient, each layer of each sample standing for a piece of surface or of a medium
/// that stays where it is, seen by the moving record as if nothing ever came between [Jarosz 2008a]. Unaware of
/// occlusion.
VolumeJet jarosz_2008a(const SphereGather& gather, VolumePart part, int order);

/// The same for any weights.
template <class Weights>
std::vector<WeighedRadiance> weigh_fixed_places(const SphereGather& gather, VolumePart part, const Weights& weights) {
  std::vector<WeighedRadiance> sums(static_cast<std::size_t>(weights.count()));
  WeightsThere there;
  const double size = cell_size(gather);
  for (std::size_t i = 0; i < gather.samples.size(); ++i) {
    const RaySum ray(gather, i, part);
    weights(ray.direction, there.values, there.slopes);
    for (std::size_t b = 0; b < sums.size(); ++b) {
      sums[b].value += ray.radiance * (there.values[b] * size);
      add(sums[b].gradient, ray.fixed, there.values[b] * size);
      // The direction of a place turns by -1/r of what the record moves by across it.
      add(sums[b].gradient, there.slopes[b], ray.over_depth * -size);
    }
  }
  return sums;
}

}  // namespace isophote
