#pragma once

#include <functional>

#include "isophote/derivatives/gather.h"

namespace isophote::test {

/// A gather whose samples are what `see` says of the cell (j, k), about z at the origin.
inline HemisphereGather imagine(Strata strata, const std::function<GatherSample(int, int)>& see) {
  HemisphereGather gather{{}, Frame(Vec3{0, 0, 1}), strata, {}};
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) {
      gather.samples.push_back(see(j, k));
      gather.samples.back().direction = strata.direction(j, k, {0.5f, 0.5f});
    }
  return gather;
}
inline GatherSample seen(float radiance, float distance = 1) {
  GatherSample sample;
  sample.radiance = Rgb(radiance);
  sample.distance = distance;
  return sample;
}

}  // namespace isophote::test
