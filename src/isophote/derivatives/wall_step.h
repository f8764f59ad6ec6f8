#pragma once

#include <algorithm>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// The radiance step from one sample to its neighbour over the wall between their strata, over the wall's distance:
/// that of the nearer surface, which covers and uncovers the other. Between two samples of the sky nothing moves.
inline Rgbd wall_step(const GatherSample& from, const GatherSample& to, float inverse_distance) {
  if (from.surface == GatherSample::own_surface || to.surface == GatherSample::own_surface) return {};
  return (Rgbd(to.radiance) - Rgbd(from.radiance)) * static_cast<double>(inverse_distance);
}
inline Rgbd wall_step(const GatherSample& from, const GatherSample& to) {
  return wall_step(from, to, std::max(1 / from.distance, 1 / to.distance));
}

}  // namespace isophote
