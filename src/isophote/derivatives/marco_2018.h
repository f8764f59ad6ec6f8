#pragma once

#include "isophote/derivatives/place_factors.h"

namespace isophote {

/// Radiance in a medium with the gradient and Hessian of its mean over directions, aware of occlusion [Marco 2018]:
/// samples of neighbouring cells are joined to triangles, layer by layer, each with the radiance of its far corners, so
/// that a step lies on the nearer surface; what is differentiated is the light of all triangles, as if each hid
/// nothing. Harmonics of higher bands have their gradients by moving walls. The Hessian takes media to be as dense on
/// the way to surfaces as at the record.
VolumeJet marco_2018(const SphereGather& gather, VolumePart part, int order);

/// The same for any lobe. The Hessian is of luminance.
struct WeighedCurvature {
  Gradient<Rgbd> gradient;
  Sym3d hessian;
};
WeighedCurvature weigh_triangles(const SphereGather& gather, VolumePart part, const Lobe& lobe = {});

}  // namespace isophote
