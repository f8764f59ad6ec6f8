#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "isophote/validity/neighbour_index.h"

namespace isophote {

/// What bounds a split-sphere radius. Each bound works alone; the defaults bound nothing.
struct RadiusBounds {
  float min_pixels = 0;  ///< [Tabellion, Lamorlette 2004], on the used radius
  float max_pixels = std::numeric_limits<float>::infinity();
  float min_view = 0;    ///< times `a`, in heights of the picture: a floor of any resolution
  float min_length = 0;  ///< scene units, on the used radius
  float max_length = std::numeric_limits<float>::infinity();
  bool gradient = false;    ///< R <= E / |grad E|, on the unscaled radius, for the channel that changes most
  bool neighbours = false;  ///< R_i <= R_j + |x_i - x_j|, on the unscaled radius [Krivanek 2006], by `settle_bounded`

  bool operator==(const RadiusBounds&) const = default;
};

/// The split-sphere metric with its radius bounded. Pixel bounds win over bounds in scene units, lower over upper ones.
Footprint bounded_split_sphere(const Jet<Rgb>& jet, const View& view, float a, const RadiusBounds& bounds);

/// What records do to each other and to themselves once inserted: neighbour clamping [Krivanek 2006], where asked; and
/// where a lower bound raised a radius above what the metric gives, that reach holds along the surface only, and
/// extrapolation is limited. `fresh` are the ids of the newest records, ascending and without gaps, which the others
/// have not met.
void settle_bounded(const Settling& settling, std::span<const std::uint32_t> fresh, float a,
                    const RadiusBounds& bounds);

}  // namespace isophote
