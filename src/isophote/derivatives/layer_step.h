#pragma once

#include <algorithm>
#include <span>

#include "isophote/derivatives/wall_distance.h"

namespace isophote {

/// What one side of a wall between two strata saw.
struct LayeredSample {
  const GatherSample& sample;
  std::span<const GatherLayer> layers;
};

/// The inverse distance of the wall between two shells, the nearer's: their depths are the same but where a surface
/// ends one of them. If the other passes that surface, `inverse_surface_distance` is that of the edge, which covers and
/// uncovers the shell.
inline float inverse_shell_distance(const LayeredSample& p, const LayeredSample& q, std::size_t l,
                                    float inverse_surface_distance, WallDistance distance) {
  const float a = p.layers[l].depth, b = q.layers[l].depth;
  const bool ends = p.sample.surface != q.sample.surface && (a == p.sample.distance || b == q.sample.distance);
  if (distance == WallDistance::minimum || !ends) return 1 / std::min(a, b);
  return std::max(1 / std::max(a, b), inverse_surface_distance);
}

/// The radiance steps, layer by layer of [first, last), over the wall between two strata, each over its distance. Layer
/// 0 is the surfaces.
inline Rgbd layer_steps(const LayeredSample& from, const LayeredSample& to, std::size_t first, std::size_t last,
                        WallDistance distance) {
  if (from.sample.surface == GatherSample::own_surface || to.sample.surface == GatherSample::own_surface) return {};
  const float inverse_surface = inverse_wall_distance(from.sample, to.sample, distance);
  Rgbd sum;
  for (std::size_t l = first; l < last; ++l) {
    const Rgb &before = from.layers[l].radiance, &after = to.layers[l].radiance;
    if (before == after) continue;
    const float inverse = l == 0 ? inverse_surface : inverse_shell_distance(from, to, l, inverse_surface, distance);
    sum += (Rgbd(after) - Rgbd(before)) * static_cast<double>(inverse);
  }
  return sum;
}

}  // namespace isophote
