#pragma once

#include <cstdint>
#include <vector>

#include "isophote/core/frame.h"
#include "isophote/core/gradient.h"
#include "isophote/core/ray.h"
#include "isophote/core/rgb.h"
#include "isophote/sampling/strata.h"

namespace isophote {

/// What one ray of a gather saw.
struct GatherSample {
  Vec3 direction;             ///< unit, world space, away from the record
  float distance = infinity;  ///< to the nearest surface, scene units, above 0; infinity: the sky
  Rgb radiance;               ///< arriving along the ray, of surface and media, finite, W/m2/sr
  Vec3 normal;                ///< unit normal of that surface, facing the record
  std::uint32_t surface = 0;  ///< which surface: samples of equal id lie on one mesh

  /// Of a sample that was not taken, its direction being under the surface on which the record lies: black, but with no
  /// edge against its neighbours that a step to the side could move.
  static constexpr std::uint32_t own_surface = 0xffffffff;
};

/// What a piece of a gather ray adds: the surface at its end, or the media in a shell of depths.
struct GatherLayer {
  Rgb radiance;                ///< arriving at the record
  float depth = infinity;      ///< where that counts as coming from; never beyond the ray's surface
  Gradient<Rgb> log_gradient;  ///< of the logarithm of what comes from there, as the record moves and the place stays:
                               ///< of transmittance and of the source's own dependence on direction, 1/m
};

/// What a record sees: one sample per stratum of the hemisphere above `position`, in the order of `strata`, as many as
/// that has.
struct HemisphereGather {
  Vec3 position;
  Frame frame;  ///< azimuth 0 along u, the pole along n
  Strata strata;
  std::vector<GatherSample> samples;
  /// Where there are media: of each sample, the surface (index 0) and `shells` shells of depths, cut at the surface.
  /// A shell that begins behind it is black and has its depth. Empty where there are none.
  int shells = 0;
  std::vector<GatherLayer> layers{};
  /// Per sample, as SphereGather's; empty where media scatter alike in all directions, or there are none.
  std::vector<Rgb> sources{};

  const GatherSample& at(int j, int k) const { return samples[static_cast<std::size_t>(j) * strata.azimuthal + k]; }
  const GatherLayer& layer(int j, int k, int l) const {
    return layers[(static_cast<std::size_t>(j) * strata.azimuthal + k) * (shells + 1) + l];
  }
};

}  // namespace isophote
