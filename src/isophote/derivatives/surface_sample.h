#pragma once

#include <algorithm>
#include <numbers>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// The piece of surface that a sample stands for, in the gather's local frame.
struct SurfaceSample {
  Rgbd irradiance;          ///< what it adds to the record's
  Vec3d direction;          ///< w, from the record
  Vec3d tilt;               ///< n_y / cos_y: the piece's normal, towards the record, over its cosine there
  double inverse_distance;  ///< 0 for the sky

  SurfaceSample(const HemisphereGather& gather, const GatherSample& sample, const Framed& frame)
      : irradiance(Rgbd(sample.radiance) * (std::numbers::pi / gather.strata.size())),
        direction(frame.to_local(Vec3d(sample.direction))),
        inverse_distance(sample.distance < infinity ? 1 / static_cast<double>(sample.distance) : 0) {
    const Vec3d normal = frame.to_local(Vec3d(sample.normal));
    // Seen edge-on, as the limbs of round things are, a piece would count without bounds.
    tilt = normal / std::max(0.05, -dot(normal, direction));
  }
};

template <class Visit>
void for_each_surface_sample(const HemisphereGather& gather, Visit&& visit) {
  const Framed frame(gather.frame);
  for (const GatherSample& sample : gather.samples) visit(SurfaceSample(gather, sample, frame));
}

}  // namespace isophote
