#include "isophote/derivatives/moving_walls.h"

namespace isophote {

SphereWalls::SphereWalls(const SphereGather& gather, VolumePart part, WallDistance distance)
    : gather_(gather), range_(gather, part), distance_(distance) {}

LayeredSample SphereWalls::at(int j, int k) const {
  const auto i = static_cast<std::size_t>(j) * gather_.strata.azimuthal + k;
  const auto layers = static_cast<std::size_t>(gather_.shells) + 1;
  return {gather_.samples[i], std::span(gather_.layers).subspan(i * layers, layers)};
}

Rgbd SphereWalls::step(int j, int k, int to_j, int to_k) const {
  return layer_steps(at(j, k), at(to_j, to_k), static_cast<std::size_t>(range_.first),
                     static_cast<std::size_t>(range_.last), distance_);
}

VolumeJet moving_walls(const SphereGather& gather, VolumePart part, int order, WallDistance distance) {
  VolumeJet jet = unweighed_jet(gather, part);
  store(jet, weigh_moving_walls(gather, part, HarmonicWeights{order}, distance));
  return jet;
}

}  // namespace isophote
