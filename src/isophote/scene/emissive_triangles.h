#pragma once

#include <cstdint>
#include <vector>

#include "isophote/scene/scene.h"
#include "isophote/scene/surface.h"

namespace isophote {

/// A triangle that emits, somewhere on it at least.
struct EmissiveTriangle {
  Vec3 origin, edge1, edge2;
  Vec3 normal;  ///< of its winding
  float area = 0;
  std::uint32_t mesh = 0, triangle = 0;
  bool double_sided = false, varies = false;  ///< varies: emission or opacity, over the triangle
  Rgb radiance;                               ///< where it does not vary
};

struct EmissiveTriangles {
  std::vector<EmissiveTriangle> triangles;  ///< by mesh and triangle
  std::vector<double> powers;               ///< luminance (W), of both sides; estimates where light varies, but never 0
};

/// All triangles of a scene but those of no area and those whose light is provably black all over. The work that goes
/// into estimates of power is bounded, however many triangles there are: it is no part of what decides who emits.
EmissiveTriangles emissive_triangles(const Scene& scene);

/// Radiance that leaves a hit, what the material lets through taken off.
Rgb covered_emission(const Scene& scene, const Hit& hit);

}  // namespace isophote
