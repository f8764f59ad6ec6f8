#pragma once

#include <span>

#include "isophote/sampling/few_choice.h"
#include "isophote/scene/emissive_triangles.h"
#include "isophote/scene/emitter.h"

namespace isophote {

/// A point of the triangle: uniform over its solid angle or, where all of it is about as far, over its area. The
/// density counts no choice of the triangle; 0: it does not shine there, from behind or in its own plane.
LightSample sample_lamp(const Scene& scene, const EmissiveTriangle& lamp, const Vec3& from, Vec2 u);

/// The density (solid angle) with which it gives the point `to`, which lies in `direction`.
float lamp_pdf(const EmissiveTriangle& lamp, const Vec3& from, const Vec3& to, const Vec3& direction);

/// Chooses among a few triangles by the light that each sends to a point where nothing is in its way and no surface
/// turned aside: its mean radiance times its solid angle, nearly. As many triangles as radiances.
FewChoice choose_lamp(std::span<const EmissiveTriangle> lamps, std::span<const float> mean_radiances, const Vec3& from);

}  // namespace isophote
