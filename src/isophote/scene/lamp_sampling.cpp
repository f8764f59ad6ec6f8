#include "isophote/scene/lamp_sampling.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/check.h"
#include "isophote/sampling/spherical_triangle.h"
#include "isophote/sampling/warp.h"

namespace isophote {
namespace {

/// Does the bright side face a point that lies in a direction from the triangle's first corner, of any length? In its
/// own plane rounding must not decide.
bool shines(const EmissiveTriangle& t, const Vec3& to_corner) {
  constexpr float in_plane = 1e-6f;
  const float height = -dot(t.normal, to_corner);
  return std::abs(height) > in_plane * length(to_corner) && (height > 0 || t.double_sided);
}

/// A triangle that is all about as far away is seen as evenly through its area, which costs less. Next to no solid
/// angle, or next to a half space, directions could not be told apart.
bool by_solid_angle(const EmissiveTriangle& t, const Vec3& from, double solid_angle) {
  const float longest = std::max({length_squared(t.edge1), length_squared(t.edge2), length_squared(t.edge2 - t.edge1)});
  return longest > 0.1f * length_squared(t.origin - from) && solid_angle > 1e-6 && solid_angle < 2 * M_PI - 1e-5;
}

double exact_solid_angle(const EmissiveTriangle& t, const Vec3& from) {
  const Vec3d a(t.origin - from);
  return solid_angle(a, a + Vec3d(t.edge1), a + Vec3d(t.edge2));
}

/// The barycentric coordinates of the point of the triangle that lies in a direction.
Vec2 where(const EmissiveTriangle& t, const Vec3& from, const Vec3d& direction) {
  const Vec3d e1(t.edge1), e2(t.edge2), s(from - t.origin), p = cross(direction, e2), q = cross(s, e1);
  const double determinant = dot(e1, p);
  const double x = std::clamp(dot(s, p) / determinant, 0.0, 1.0);
  return {static_cast<float>(x), static_cast<float>(std::clamp(dot(direction, q) / determinant, 0.0, 1 - x))};
}

/// `solid_angle`: the lamp's.
float density(const EmissiveTriangle& lamp, double solid_angle, const Vec3& from, const Vec3& to,
              const Vec3& direction) {
  if (by_solid_angle(lamp, from, solid_angle)) return static_cast<float>(1 / solid_angle);
  const float cosine = std::abs(dot(lamp.normal, direction));
  return cosine > 0 ? length_squared(to - from) / (lamp.area * cosine) : 0.0f;
}

}  // namespace

float lamp_pdf(const EmissiveTriangle& lamp, const Vec3& from, const Vec3& to, const Vec3& direction) {
  if (!shines(lamp, lamp.origin - from)) return 0;
  return density(lamp, exact_solid_angle(lamp, from), from, to, direction);
}

LightSample sample_lamp(const Scene& scene, const EmissiveTriangle& lamp, const Vec3& from, Vec2 u) {
  if (!shines(lamp, lamp.origin - from)) return {};
  const double angle = exact_solid_angle(lamp, from);
  Vec2 b;
  if (by_solid_angle(lamp, from, angle)) {
    const Vec3d a(lamp.origin - from), e1(lamp.edge1), e2(lamp.edge2);
    b = where(lamp, from, uniform_spherical_triangle(a, a + e1, a + e2, angle, u));
  } else {
    b = uniform_triangle(u);
  }
  const Vec3 to = lamp.origin + lamp.edge1 * b.x + lamp.edge2 * b.y;
  const float distance = length(to - from);
  if (!(distance > 0)) return {};
  const Vec3 direction = (to - from) / distance;
  const float pdf = density(lamp, angle, from, to, direction);
  if (!(pdf > 0)) return {};
  const Rgb radiance = lamp.varies ? covered_emission(scene, {lamp.mesh, lamp.triangle, b.x, b.y}) : lamp.radiance;
  const float lift = ray_offset(to, lamp.origin, lamp.edge1, lamp.edge2, distance);
  const Vec3 end = to + lamp.normal * std::copysign(lift, -dot(lamp.normal, direction));
  return {direction, distance, radiance, pdf, false, true, end};
}

FewChoice choose_lamp(std::span<const EmissiveTriangle> lamps, std::span<const float> mean_radiances,
                      const Vec3& from) {
  ISOPHOTE_CHECK(lamps.size(), ==, mean_radiances.size());
  return {lamps.size(), [&](std::uint32_t i) {
            const EmissiveTriangle& t = lamps[i];
            if (!shines(t, t.origin - from)) return 0.0f;
            const Vec3d a(t.origin - from);
            return mean_radiances[i] * static_cast<float>(about_solid_angle(a, a + Vec3d(t.edge1), a + Vec3d(t.edge2)));
          }};
}

}  // namespace isophote
