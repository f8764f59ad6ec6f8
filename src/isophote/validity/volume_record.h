#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "isophote/derivatives/volume_radiance.h"
#include "isophote/validity/record.h"

namespace isophote {

/// A place in media at which the radiance that arrives there is known as a function of direction, with its derivatives
/// and the region where they may be used. It lies on no surface: its normal is 0, and its footprint minds none. It is
/// extrapolated to the first order at most.
struct VolumeRecord : Site {
  std::uint32_t media = 0;  ///< bit i: the bounds of the i-th medium hold it
  VolumeJet jet;

  /// Is there a gradient to extrapolate by?
  bool has_slope() const { return footprint.order > 0 && !jet.translational.x.empty(); }
};

/// The luminance of radiance, the mean over all directions: the first harmonic is 1 / sqrt(4 pi) everywhere.
inline double mean_over_directions(const VolumeJet& jet) {
  return jet.value.empty() ? 0 : luminance(Rgbd(jet.value[0])) / std::sqrt(4 * std::numbers::pi);
}

}  // namespace isophote
