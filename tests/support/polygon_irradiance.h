#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "isophote/core/vec.h"
#include "isophote/harmonics/quadrature.h"

namespace isophote::test {

/// A flat convex polygon, its corners in either order.
using Polygon = std::vector<Vec3d>;

/// The part of `polygon` on the side of the plane through `origin` that `normal` points to.
inline Polygon clip(const Polygon& polygon, const Vec3d& origin, const Vec3d& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double height_a = dot(a - origin, normal), height_b = dot(b - origin, normal);
    if (height_a >= 0) kept.push_back(a);
    if ((height_a >= 0) != (height_b >= 0)) kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
  }
  return kept;
}

/// The integral of weight . w over the directions w in which `polygon` is seen from x: irradiance where the weight is
/// the normal and the polygon above its horizon. Lambert's sum over the edges, each the angle it subtends times half
/// the unit normal of its plane through x; turned so that a normal that looks at the polygon gets a positive value.
inline double lambert_integral(const Vec3d& x, const Vec3d& weight, const Polygon& polygon) {
  Vec3d sum, middle;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i] - x, b = polygon[(i + 1) % polygon.size()] - x, c = cross(a, b);
    const double area = length(c);
    if (area > 0) sum += c * (std::atan2(area, dot(a, b)) / area / 2);
    middle += a;
  }
  return dot(sum, weight) * (dot(sum, middle) < 0 ? -1 : 1);
}

/// The integral over a triangle of radiance(y) weight . w cos / r^2, cut into four until no edge is longer than 0.8 of
/// the distance.
template <class Radiance>
double triangle_integral(const Vec3d& x, const Vec3d& weight, const Vec3d& a, const Vec3d& b, const Vec3d& c,
                         const Radiance& radiance) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  const double nearest = std::min({length(a - x), length(b - x), length(c - x), length((a + b + c) / 3.0 - x)});
  if (longest > 0.8 * nearest) {
    const Vec3d ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    return triangle_integral(x, weight, a, ab, ca, radiance) + triangle_integral(x, weight, ab, b, bc, radiance) +
           triangle_integral(x, weight, ca, bc, c, radiance) + triangle_integral(x, weight, ab, bc, ca, radiance);
  }
  // The unit square folded onto the triangle: y = a + s ((b - a) (1 - t) + (c - a) t), whose Jacobian is s |area|.
  const Vec3d area = cross(b - a, c - a);
  double sum = 0;
  const auto& gauss = GaussRule<10>::get();
  gauss.integrate(0, 1, [&](double s, double weight_s) {
    gauss.integrate(0, 1, [&](double t, double weight_t) {
      const Vec3d y = a + ((b - a) * (1 - t) + (c - a) * t) * s, d = y - x;
      const double r2 = length_squared(d);
      sum += weight_s * weight_t * s * radiance(y) * dot(weight, d) * std::abs(dot(area, d)) / (r2 * r2);
    });
  });
  return sum;
}

/// The integral of radiance(y) weight . w over the directions w in which the points y of `polygon` are seen from x, to
/// about 13 digits where the radiance is smooth. The polygon must be away from x.
template <class Radiance>
double gauss_integral(const Vec3d& x, const Vec3d& weight, const Polygon& polygon, const Radiance& radiance) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += triangle_integral(x, weight, polygon[0], polygon[i], polygon[i + 1], radiance);
  return sum;
}

/// The derivative of f at 0 from four values, with an error of the order of step^4.
template <class F>
double central_difference(const F& f, double step = 4e-3) {
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

}  // namespace isophote::test
