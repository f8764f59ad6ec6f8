#pragma once

#include "isophote/cache/record_cache.h"
#include "isophote/image/false_colour.h"
#include "isophote/integrate/volume_slice.h"

namespace isophote {

/// What the colour of a footprint tells: its radius, in metres, as that of a disk of the same area or, in media, of a
/// ball of the same volume; or the error that the use of its record at its rim predicts, of which records in media say
/// nothing.
enum class RecordColour { radius, error };

/// A picture, the scale of its colours and where it cuts the media.
struct ColouredPicture {
  RgbImage picture;
  ColourScale scale;
  std::optional<Plane> slice;
};

/// The records over a dimmed picture of the irradiance: each with a dot where it lies and the rim of its footprint, a
/// line as wide everywhere however the surface is seen. Where there are records in media, `volume_slice` stands before
/// the surfaces, on the plane `slice` or, without, on that amid them. Meant for sRGB display without further exposure.
ColouredPicture record_picture(const Job& job, const RecordCache& cache, RecordColour colour,
                               const std::optional<Plane>& slice = {});

}  // namespace isophote
