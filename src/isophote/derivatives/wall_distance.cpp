#include "isophote/derivatives/wall_distance.h"

namespace isophote {
namespace {

/// Across a step, the nearer surface as far as its tangent plane reaches the wall, but not behind the other, nor much
/// nearer than where it was met.
float across_step(const GatherSample& p, const GatherSample& q) {
  const GatherSample &near = p.distance < q.distance ? p : q, &far = p.distance < q.distance ? q : p;
  if (near.distance == infinity) return 0;
  return std::clamp(inverse_along(near, normalize(p.direction + q.direction)), 1 / far.distance, 4 / near.distance);
}

}  // namespace

float inverse_wall_distance(const GatherSample& p, const GatherSample& q, WallDistance distance) {
  const float a = 1 / p.distance, b = 1 / q.distance;
  switch (distance) {
    case WallDistance::minimum:
      break;
    case WallDistance::harmonic:
      if (one_surface(p, q)) return (a + b) / 2;
      break;
    case WallDistance::refined:
      // An occluder close to what it hides passes for one surface with it, but for being another: what its edge
      // uncovers would stay wrong, however fine the strata.
      return p.surface == q.surface && one_surface(p, q) ? (a + b) / 2 : across_step(p, q);
  }
  return std::max(a, b);
}

}  // namespace isophote
