#pragma once

#include "isophote/validity/record.h"

namespace isophote {

/// The region of a footprint for equal normals, in lengths: an ellipse in the record's tangent plane, and how far it
/// reaches off that plane.
struct SemiAxes {
  float longer = 0, shorter = 0;
  float height = 0;
  Vec3 axis;  ///< unit, along the longer

  /// The radius of the disk of the same area.
  float mean() const { return std::sqrt(longer * shorter); }
};

/// Holds for footprints as metrics make them: the record's normal is one of the shape's axes.
SemiAxes semi_axes(const Record& record);

/// The radius of the ball of the same volume, of a footprint in media.
float ball_radius(const Footprint& footprint);

}  // namespace isophote
