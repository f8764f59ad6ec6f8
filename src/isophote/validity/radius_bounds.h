#pragma once

#include <algorithm>
#include <limits>

#include "isophote/validity/footprint.h"

namespace isophote {

/// What bounds the radius that a metric gives. Each bound works alone; the defaults bound nothing.
struct RadiusBounds {
  float min_pixels = 0;  ///< [Tabellion, Lamorlette 2004], on the used radius
  float max_pixels = std::numeric_limits<float>::infinity();
  float min_view = 0;    ///< times the threshold, in heights of the picture: a floor of any resolution
  float min_length = 0;  ///< scene units, on the used radius
  float max_length = std::numeric_limits<float>::infinity();
  bool gradient = false;    ///< R <= E / |grad E|, on the unscaled radius, for the channel that changes most
  bool neighbours = false;  ///< among records that face alike, by `settle`

  bool operator==(const RadiusBounds&) const = default;
};

/// The least and the largest radius that bounds allow at a place. Pixel bounds win over bounds in scene units, lower
/// over upper ones; no radius is above the scene's size or under `smallest_radius` of it.
struct RadiusRange {
  float smallest, largest;

  RadiusRange(const RadiusBounds& bounds, const View& view, float threshold) {
    const float pixels = bounds.max_pixels == std::numeric_limits<float>::infinity() ? bounds.max_pixels
                                                                                     : bounds.max_pixels * view.pixel;
    const float wanted = std::max(bounds.min_length, bounds.min_view * threshold * view.picture);
    smallest = std::max({std::min(wanted, pixels), bounds.min_pixels * view.pixel, smallest_radius * view.scene_scale});
    largest = std::max(smallest, std::min({bounds.max_length, pixels, view.scene_scale}));
  }
};

}  // namespace isophote
