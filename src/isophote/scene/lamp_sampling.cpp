#include "isophote/scene/lamp_sampling.h"

#include <algorithm>
#include <cmath>

#include "isophote/sampling/spherical_triangle.h"
#include "isophote/sampling/warp.h"

namespace isophote {
namespace {

bool shines(const EmissiveTriangle& t, const Vec3& direction) {
  const float cosine = -dot(t.normal, direction);
  return cosine > 0 || (cosine < 0 && t.double_sided);
}

/// Below the first, area serves as well and costs less; above the second, next to the plane, no direction can be told
/// from another.
bool by_solid_angle(float solid_angle) { return solid_angle > 0.01f && solid_angle < 2 * pi - 1e-3f; }

/// The barycentric coordinates of the point of the triangle that lies in a direction.
Vec2 where(const EmissiveTriangle& t, const Vec3& from, const Vec3d& direction) {
  const Vec3d e1(t.edge1), e2(t.edge2), s(from - t.origin), p = cross(direction, e2), q = cross(s, e1);
  const double determinant = dot(e1, p);
  const double x = std::clamp(dot(s, p) / determinant, 0.0, 1.0);
  return {static_cast<float>(x), static_cast<float>(std::clamp(dot(direction, q) / determinant, 0.0, 1 - x))};
}

}  // namespace

float lamp_solid_angle(const EmissiveTriangle& lamp, const Vec3& from) {
  const Vec3 to = lamp.origin - from;
  if (!shines(lamp, to)) return 0;
  return static_cast<float>(solid_angle(Vec3d(to), Vec3d(to + lamp.edge1), Vec3d(to + lamp.edge2)));
}

float lamp_pdf(const EmissiveTriangle& lamp, float solid_angle, const Vec3& from, const Vec3& to,
               const Vec3& direction) {
  if (!shines(lamp, direction)) return 0;
  if (by_solid_angle(solid_angle)) return 1 / solid_angle;
  return length_squared(to - from) / (lamp.area * std::abs(dot(lamp.normal, direction)));
}

LightSample sample_lamp(const Scene& scene, const EmissiveTriangle& lamp, float solid_angle, const Vec3& from, Vec2 u) {
  Vec2 b;
  if (by_solid_angle(solid_angle)) {
    const Vec3d a(lamp.origin - from), e1(lamp.edge1), e2(lamp.edge2);
    b = where(lamp, from, uniform_spherical_triangle(a, a + e1, a + e2, solid_angle, u));
  } else {
    b = uniform_triangle(u);
  }
  const Vec3 to = lamp.origin + lamp.edge1 * b.x + lamp.edge2 * b.y;
  const float distance = length(to - from);
  if (!(distance > 0)) return {};
  const Vec3 direction = (to - from) / distance;
  const float density = lamp_pdf(lamp, solid_angle, from, to, direction);
  if (!(density > 0)) return {};
  const Rgb radiance = lamp.varies ? covered_emission(scene, {lamp.mesh, lamp.triangle, b.x, b.y}) : lamp.radiance;
  const float lift = ray_offset(to, lamp.origin, lamp.edge1, lamp.edge2, distance);
  const Vec3 end = to + lamp.normal * std::copysign(lift, -dot(lamp.normal, direction));
  return {direction, distance, radiance, density, false, true, end};
}

LampChoice::LampChoice(std::span<const EmissiveTriangle> lamps, std::span<const float> mean_radiances, const Vec3& from)
    : count_(static_cast<std::uint32_t>(lamps.size())) {
  constexpr float alike = 0.1f;
  float sum = 0;
  int shining = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    solid_angles_[i] = lamp_solid_angle(lamps[i], from);
    chances_[i] = mean_radiances[i] * solid_angles_[i];
    sum += chances_[i], shining += chances_[i] > 0;
  }
  if (!(sum > 0)) return;
  for (std::uint32_t i = 0; i < count_; ++i)
    if (chances_[i] > 0)
      chances_sum_ += chances_[i] = (1 - alike) * chances_[i] + alike * sum / static_cast<float>(shining);
}

std::uint32_t LampChoice::sample(float u) const {
  const float wanted = u * chances_sum_;
  float sum = 0;
  std::uint32_t chosen = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (!(chances_[i] > 0)) continue;
    chosen = i;
    if (wanted < (sum += chances_[i])) break;
  }
  return chosen;
}

}  // namespace isophote
