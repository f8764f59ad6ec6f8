#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/image/false_colour.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// What the colour of a footprint tells: its radius, in metres, as that of a disk of the same area; or the error that
/// the use of its record at its rim predicts.
enum class RecordColour { radius, error };

/// A picture and the scale of its colours.
struct ColouredPicture {
  RgbImage picture;
  ColourScale scale;
};

/// The records over a dimmed picture of the irradiance: each with a dot where it lies and the rim of its footprint, a
/// line as wide everywhere however the surface is seen. Meant for sRGB display without further exposure.
ColouredPicture record_picture(const Job& job, const RecordCache& cache, RecordColour colour);

}  // namespace isophote
