#include "isophote/sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isophote {
namespace {

/// The unit vector of the plane of x and y that is orthogonal to the unit vector y, on x's side.
Vec3d beside(const Vec3d& x, const Vec3d& y) { return normalize(x - y * dot(x, y)); }

/// Half the solid angle that a triangle fills is that of the point (x, y) [van Oosterom, Strackee 1983].
struct HalfAngle {
  double x, y;

  HalfAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double la = length(a), lb = length(b), lc = length(c);
    x = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    y = std::abs(dot(a, cross(b - a, c - a)));  // of the edges: exact enough for small triangles too
  }
};

double side(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

}  // namespace

double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const HalfAngle half(a, b, c);
  return 2 * std::atan2(half.y, half.x);
}

// y / (x + y) stands for the arc tangent of y / x, which costs most.
double about_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto [x, y] = HalfAngle(a, b, c);
  return x > 0 ? std::numbers::pi * y / (x + y) : std::numbers::pi * (2 - y / (y - x));
}

Vec3d uniform_spherical_triangle(const Vec3d& a_, const Vec3d& b_, const Vec3d& c_, double solid_angle, Vec2 u) {
  const Vec3d a = normalize(a_), b = normalize(b_), c = normalize(c_);
  const Vec3d ab = beside(b, a), ac = beside(c, a);
  const double cos_alpha = dot(ab, ac), sin_alpha = length(cross(ab, ac));  // of the angle at a
  // A great circle through b cuts off u.x of the triangle: it meets the side from a to c in d.
  const double sin_part = std::sin(u.x * solid_angle), cos_part = std::cos(u.x * solid_angle);
  const double s = sin_part * cos_alpha - cos_part * sin_alpha, t = cos_part * cos_alpha + sin_part * sin_alpha;
  const double p = t - cos_alpha, q = s + sin_alpha * dot(a, b);
  const double cos_d = std::clamp(((q * t - p * s) * cos_alpha - q) / ((q * s + p * t) * sin_alpha), -1.0, 1.0);
  const Vec3d d = a * cos_d + ac * side(cos_d);
  const double z = 1 - u.y * (1 - dot(d, b));
  return b * z + beside(d, b) * side(z);
}

}  // namespace isophote
