#include "isophote/derivatives/jarosz_2012.h"

#include "isophote/derivatives/krivanek_2005a.h"
#include "isophote/derivatives/surface_sample.h"
#include "isophote/derivatives/tangent.h"

namespace isophote {

Jet<Rgb> jarosz_2012(const HemisphereGather& gather) {
  Jet<Rgb> jet = krivanek_2005a(gather);
  TangentHessian hessian;
  for_each_surface_sample(gather, [&](const SurfaceSample& s) {
    const double light = luminance(s.irradiance) * s.inverse_distance * s.inverse_distance;
    const Vec3d &w = s.direction, &n = s.tilt;
    hessian.uu += light * (24 * w.x * w.x + 8 * n.x * w.x - 4);
    hessian.uv += light * (24 * w.x * w.y + 4 * (n.x * w.y + n.y * w.x));
    hessian.vv += light * (24 * w.y * w.y + 8 * n.y * w.y - 4);
  });
  jet.hessian = hessian.to_world(gather.frame);
  return jet;
}

}  // namespace isophote
