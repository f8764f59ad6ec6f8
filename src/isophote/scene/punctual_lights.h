#pragma once

#include <vector>

#include "isophote/sampling/distribution.h"
#include "isophote/scene/emitter.h"

namespace isophote {

/// The punctual lights of a scene. No ray can meet them, so they are no part of multiple importance sampling and are
/// sampled by themselves.
class PunctualLights {
 public:
  /// `scene` must outlive this.
  explicit PunctualLights(const Scene& scene);

  bool empty() const { return by_power_.empty(); }
  /// One light that is not black, chosen by u in [0, 1): among few by the irradiance at `from` that each would give if
  /// nothing hid it, so that visibility alone makes noise; among more by power. `pdf` is the chance; 0 where none
  /// shines on `from`.
  LightSample sample(const Vec3& from, float u) const;

 private:
  const std::vector<PunctualLight>& lights_;
  AliasTable by_power_;
};

}  // namespace isophote
