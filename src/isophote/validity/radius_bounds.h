#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "isophote/validity/footprint.h"

namespace isophote {

/// What bounds the radius that a metric gives. Each bound works alone; the defaults bound nothing.
struct RadiusBounds {
  float min_pixels = 0;  ///< [Tabellion, Lamorlette 2004], on the used radius
  float max_pixels = std::numeric_limits<float>::infinity();
  float min_view = 0;  ///< times the threshold, in heights of the picture: a floor of any resolution
  float max_view = std::numeric_limits<float>::infinity();  ///< heights of the picture
  float min_length = 0;                                     ///< scene units, on the used radius
  float max_length = std::numeric_limits<float>::infinity();
  bool gradient = false;  ///< R <= E / |grad E|: on the unscaled radius, for the channel that changes most; metrics of
                          ///< footprints with axes say how they take it
  float neighbours = 0;   ///< R_i <= R_j + so many times their distance, by `settle`; 0: no such bound

  bool operator==(const RadiusBounds&) const = default;
};

/// The least and the largest radius that bounds allow at a place. Pixels win over heights of the picture, these over
/// scene units, lower over upper ones of a kind; no radius is above the scene's size or under `smallest_radius` of it.
struct RadiusRange {
  float smallest, largest;

  RadiusRange(const RadiusBounds& bounds, const View& view, float threshold) {
    // Where a pixel spans nothing, an infinite bound stays one.
    const auto times = [](float bound, float size) {
      return bound == std::numeric_limits<float>::infinity() ? bound : bound * size;
    };
    const float most_pixels = times(bounds.max_pixels, view.pixel);
    const float most = std::min(most_pixels, times(bounds.max_view, view.picture));
    smallest =
        std::max({std::min(bounds.min_length, most), std::min(bounds.min_view * threshold * view.picture, most_pixels),
                  bounds.min_pixels * view.pixel, smallest_radius * view.scene_scale});
    largest = std::max(smallest, std::min({bounds.max_length, most, view.scene_scale}));
  }
};

}  // namespace isophote
