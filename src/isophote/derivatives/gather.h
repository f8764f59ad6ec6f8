#pragma once

#include <cstdint>
#include <vector>

#include "isophote/core/frame.h"
#include "isophote/core/ray.h"
#include "isophote/core/rgb.h"
#include "isophote/sampling/strata.h"

namespace isophote {

/// What one ray of a gather saw.
struct GatherSample {
  Vec3 direction;             ///< unit, world space, away from the record
  float distance = infinity;  ///< to the nearest surface; infinity: the sky
  Rgb radiance;               ///< arriving along the ray
  Vec3 normal;                ///< unit normal of that surface, facing the record
  std::uint32_t surface = 0;  ///< which surface: samples of equal id lie on one mesh
};

/// What a record sees: one sample per stratum of the hemisphere above `position`, in the order of `strata`.
struct HemisphereGather {
  Vec3 position;
  Frame frame;  ///< azimuth 0 along u, the pole along n
  Strata strata;
  std::vector<GatherSample> samples;

  const GatherSample& at(int j, int k) const { return samples[static_cast<std::size_t>(j) * strata.azimuthal + k]; }
};

}  // namespace isophote
