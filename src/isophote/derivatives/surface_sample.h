#pragma once

#include <algorithm>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// The piece of surface that a sample stands for, in the gather's local frame.
struct SurfaceSample {
  Vec3d direction;          ///< w, from the record
  Vec3d tilt;               ///< n_y / cos_y: the piece's normal, towards the record, over its cosine there
  double inverse_distance;  ///< 0 for the sky

  SurfaceSample(const GatherSample& sample, const Framed& frame)
      : direction(frame.to_local(Vec3d(sample.direction))),
        inverse_distance(sample.distance < infinity ? 1 / static_cast<double>(sample.distance) : 0) {
    const Vec3d normal = frame.to_local(Vec3d(sample.normal));
    // Seen edge-on, as the limbs of round things are, a piece would count without bounds.
    tilt = normal / std::max(0.05, -dot(normal, direction));
  }
};

}  // namespace isophote
