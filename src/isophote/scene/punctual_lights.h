#pragma once

#include <vector>

#include "isophote/sampling/distribution.h"
#include "isophote/scene/emitter.h"

namespace isophote {

/// The punctual lights of a scene, or those of some kinds. No ray can meet them, so they are no part of multiple
/// importance sampling and are sampled by themselves.
class PunctualLights {
 public:
  /// `scene` must outlive this.
  explicit PunctualLights(const Scene& scene, PunctualKinds kinds = PunctualKinds::all);

  /// How many samples to take, whose light adds up: as many as there are lights where they are few, so that none is
  /// noise beside another; else one.
  int samples() const;
  /// The i-th of them at `from`. Where lights are many it is chosen by u in [0, 1): of up to 32 by the irradiance that
  /// each would give if nothing hid it, of more by power, with a tenth of the choice to all alike. `pdf` is the chance
  /// of the choice; 0 where the light does not shine on `from`.
  LightSample sample(int i, const Vec3& from, float u) const;
  /// The i-th of them by itself, for whatever place: where lights are many, by power.
  struct Chosen {
    const PunctualLight* light = nullptr;
    float chance = 1;
  };
  Chosen choose(int i, float u) const;

 private:
  LightSample sample_by_irradiance(const Vec3& from, float u) const;

  std::vector<const PunctualLight*> lights_;
  AliasTable by_power_;
};

/// What a light sends to `from`, alone.
LightSample punctual_light_at(const PunctualLight& light, const Vec3& from);

}  // namespace isophote
