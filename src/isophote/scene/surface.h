#pragma once

#include <cstdint>

#include "isophote/core/ray.h"
#include "isophote/scene/bsdf.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// Where a ray met a triangle.
struct Hit {
  std::uint32_t mesh = 0, triangle = 0;
  float u = 0, v = 0;  ///< barycentric coordinates of the second and third vertex
  float distance = infinity;
};

/// A point of a surface as light sees it. All normals are unit and on the side the ray came from.
struct SurfacePoint {
  Vec3 position;
  Vec3 geometric_normal;
  Vec3 shading_normal;  ///< interpolated, before the normal map: cached records live on it
  Bsdf bsdf;            ///< bsdf.frame.n is the mapped normal
  Rgb emission;         ///< radiance towards the ray's origin (0 on a side that does not emit)
  Rgb attenuation;      ///< sigma_a (1/m) of the medium behind the surface, for solid glass
  Rgb medium;           ///< that on the ray's side: of this solid, met from within, or of one that the path knows of
  std::uint32_t mesh = 0, triangle = 0;
  float offset = 0;   ///< length by which rays keep off the surface: `ray_offset` here
  bool front = true;  ///< met on the side its winding faces
};

SurfacePoint surface_point(const Scene& scene, const Ray& ray, const Hit& hit);

/// Opacity of the material at a hit: 0 or 1 for masks, coverage for blending.
float opacity(const Scene& scene, const Hit& hit);

/// Radiance that the material emits at a hit, whichever side it is seen from.
Rgb emission(const Scene& scene, const Hit& hit);

/// The length by which rays keep off the triangle (p, p + e1, p + e2) at `position`, so as not to meet the triangle
/// itself: more than rounding moves either along the normal, a few units in the last place (2^-24) of the coordinates
/// there. The normals of triangles some thousand times as long as high are rounded so much that rays would have to keep
/// further off than the triangle is high: they keep off by up to a quarter of that, and a few may meet it. It knows
/// nothing of the rest of the scene, and scales with units of length. `ray_length` counts for rays that end there.
float ray_offset(const Vec3& position, const Vec3& p, const Vec3& e1, const Vec3& e2, float ray_length = 0);

/// Where a ray that leaves `point` towards `direction` starts: off the surface on that side, by point.offset.
Vec3 offset_origin(const SurfacePoint& point, const Vec3& direction);

}  // namespace isophote
