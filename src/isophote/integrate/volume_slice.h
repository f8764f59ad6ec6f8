#pragma once

#include <functional>
#include <optional>

#include "isophote/integrate/marked_picture.h"
#include "isophote/validity/volume_record.h"

namespace isophote {

/// The plane through a point across a unit normal.
struct Plane {
  Vec3 point, normal;
};

/// The plane across the camera's direction of view, halfway between the nearest and the farthest record in media along
/// it, through a point on the axis of the picture. Nothing where there are no such records.
std::optional<Plane> plane_amid_records(const Job& job, const RecordCache& cache);

/// What a plane shows of the records in media: the rims in which it cuts their footprints, where these hold, coloured
/// by `colour`, over the light that is cached there, as the irradiance that its mean over all directions would be on a
/// surface: black where records of either part are lacking. Rims of multiple scattering lie over those of light from
/// surfaces, which are dashed. Nothing where the plane lies behind a surface or outside the media. The job and the
/// cache, which has such records, outlive it.
Screen volume_slice(const Job& job, const RecordCache& cache, const Plane& plane,
                    std::function<Rgb(const VolumeRecord&)> colour);

}  // namespace isophote
