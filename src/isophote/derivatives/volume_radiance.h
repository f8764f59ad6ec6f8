#pragma once

#include "isophote/core/ray.h"
#include "isophote/derivatives/incident_radiance.h"
#include "isophote/derivatives/sphere_gather.h"

namespace isophote {

/// Radiance arriving at a point from all directions (W/m2/sr), as coefficients of spherical harmonics in world axes:
/// order^2 of them, by `harmonic_index`. What a phase function f scatters of it towards wo, per unit of sigma_s, is
/// its product with the coefficients of f. Gradients are per metre, along x, y and z of world space; there is no
/// rotational one. The Hessian is that of the luminance of the mean radiance, fluence over 4 pi.
struct VolumeJet : Jet<Coefficients> {
  /// Luminance of the mean radiance, sample by sample, and the magnitudes of its gradient, likewise: a sample's layers
  /// are summed before its magnitude is taken [Jarosz 2008a].
  float value_sum = 0, gradient_sum = 0;
  ObstaclesAround obstacles;  ///< surfaces seen
};

/// What of a gather is meant: light of surfaces and the sky (layer 0), or of media (the shells).
enum class VolumePart : std::uint8_t { surfaces, media };

/// Radiance in `order` bands without derivatives, but with the sums of samples' magnitudes: each sample stands for its
/// cell. Those of the other estimators are the same. A sample's gradient there is that of jarosz_2008a.
VolumeJet volume_radiance(const SphereGather& gather, VolumePart part, int order);

}  // namespace isophote
