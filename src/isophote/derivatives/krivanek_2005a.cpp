#include "isophote/derivatives/krivanek_2005a.h"

#include "isophote/derivatives/surface_sample.h"
#include "isophote/derivatives/tangent.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {

Jet<Rgb> krivanek_2005a(const HemisphereGather& gather) {
  Jet<Rgb> jet = irradiance(gather);
  TangentGradient gradient;
  for_each_surface_sample(gather, [&](const SurfaceSample& s) {
    const Rgbd light = s.irradiance * s.inverse_distance;
    gradient.u += light * (4 * s.direction.x + s.tilt.x);
    gradient.v += light * (4 * s.direction.y + s.tilt.y);
  });
  jet.translational = gradient.to_world(gather.frame);
  jet.rotational = rotational_gradient(gather, RotationWeights::exact);
  return jet;
}

}  // namespace isophote
