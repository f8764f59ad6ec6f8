#pragma once

#include <array>
#include <span>

#include "isophote/scene/emissive_triangles.h"
#include "isophote/scene/emitter.h"

namespace isophote {

/// The solid angle that the triangle's bright side fills, seen from `from`: 0 from behind.
float lamp_solid_angle(const EmissiveTriangle& lamp, const Vec3& from);

/// A point of the triangle, whose solid angle is given: uniform over that or, where it is small, over the area. The
/// density counts no choice of the triangle; 0: it does not shine there.
LightSample sample_lamp(const Scene& scene, const EmissiveTriangle& lamp, float solid_angle, const Vec3& from, Vec2 u);

/// The density (solid angle) with which it gives the point `to`, which lies in `direction`.
float lamp_pdf(const EmissiveTriangle& lamp, float solid_angle, const Vec3& from, const Vec3& to,
               const Vec3& direction);

/// Chooses among a few triangles by the light that each sends to a point where nothing is in its way and no surface
/// turned aside: its mean radiance times its solid angle. A tenth of the choice goes to all that shine there alike.
class LampChoice {
 public:
  static constexpr std::size_t most = 32;

  LampChoice(std::span<const EmissiveTriangle> lamps, std::span<const float> mean_radiances, const Vec3& from);

  /// Does none shine there?
  bool empty() const { return !(chances_sum_ > 0); }
  /// An index, for u in [0, 1), or that of the last that shines there. Not on an empty one.
  std::uint32_t sample(float u) const;
  float chance(std::uint32_t i) const { return chances_[i] / chances_sum_; }
  float solid_angle(std::uint32_t i) const { return solid_angles_[i]; }

 private:
  std::array<float, most> solid_angles_;
  std::array<float, most> chances_;  // up to a factor
  float chances_sum_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace isophote
