#pragma once

#include "isophote/integrate/far_light.h"

namespace isophote {

/// What media do along a straight way: light that they scatter and emit towards its origin, split as `Scattered` is,
/// and what they leave of the light from its end.
struct Marched {
  Rgb direct, indirect, transmittance{1.0f};
  bool covered = true;  ///< false: somewhere no record served
};

/// What becomes of places that no record serves: a path goes on there, or nothing is known of the whole way.
enum class WhereUncovered : std::uint8_t { path, nothing };

/// Looks at a few places of the way, chosen by what is seen from there, for light of directly sampled emitters, by
/// light sampling, and for the rest, `from` what is known (`seen_in_scattering`) or by a path where no record serves.
/// The world has media; `depth` counts the scattering events before.
Marched march(const World& world, const FarLight& from, const Ray& way, int depth, WhereUncovered uncovered,
              Sampler& sampler, RayCounts& counts);

}  // namespace isophote
