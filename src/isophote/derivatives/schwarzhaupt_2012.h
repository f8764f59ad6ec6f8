#pragma once

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"

namespace isophote {

/// Where the triangles over a gather's hits end: at a ring of points on the horizon, or at the outermost hits, which
/// leaves derivatives of what the last half ring would have been, and a furnace with derivatives other than 0.
enum class Horizon { closed, open };

/// Irradiance with the occlusion-aware gradient and Hessian of the triangulated hemisphere [Schwarzhaupt 2012]: hits of
/// neighbouring strata are joined to triangles, each with the radiance of its farthest corner, so that a step lies on
/// the nearer surface; what is differentiated is their irradiance as if each hid nothing. The pole is closed by a point
/// on the normal, at the harmonic mean distance of the first ring.
Jet<Rgb> schwarzhaupt_2012(const HemisphereGather& gather, Horizon horizon);

}  // namespace isophote
