#pragma once

#include <string_view>

#include "isophote/integrate/explain.h"
#include "isophote/integrate/marked_picture.h"

namespace isophote {

/// The colours in which the records that serve are drawn, the greatest share first; all others share the last.
struct LegendColour {
  std::string_view name;
  Rgb colour;
};
const LegendColour& legend_colour(std::size_t rank);

/// The surroundings of pixel (x, y), enlarged so that the footprints of the records that made it fill the picture: the
/// irradiance, dimmed, under the rims of those footprints and, thin and grey, of records that nearly served. A cross is
/// at the pixel. Meant for sRGB display without further exposure.
struct ExplanationPicture {
  RgbImage picture;
  Window window;
};
ExplanationPicture explanation_picture(const Job& job, const RecordCache& cache, const Explanation& explanation, int x,
                                       int y);

}  // namespace isophote
