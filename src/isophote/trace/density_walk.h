#pragma once

#include "isophote/core/ray.h"
#include "isophote/scene/medium.h"

namespace isophote {

/// Density of a medium at a point of its bounds.
float density_at(const Medium& medium, const Vec3& p);

/// The box about a medium's bounds, and the most that its density is there.
Box box_about(const Medium& medium);
float largest_density(const Medium& medium);

/// A place along a ray, with a bound on the density there.
struct FlightEnd {
  float distance = infinity;  ///< infinity: beyond the end
  float bound = 0;
};

/// How far from `from` one comes along the ray before the bound on density, integrated, reaches `amount` (m times
/// density): to a place before `to`, or infinitely far. The bound is the density itself where it is no grid.
FlightEnd fly(const Medium& medium, const Ray& ray, float from, float to, float amount);

/// Integrals along a ray from its origin, s being the distance from there.
struct Columns {
  double density = 0;     ///< of density
  Vec3d gradient;         ///< of the gradient of density
  Vec3d gradient_moment;  ///< of s times that

  Columns& operator+=(const Columns& o) {
    density += o.density, gradient += o.gradient, gradient_moment += o.gradient_moment;
    return *this;
  }
};
/// What from <= s <= to adds to them: exact but for rounding, grids cell by cell.
Columns columns(const Medium& medium, const Ray& ray, float from, float to);

}  // namespace isophote
