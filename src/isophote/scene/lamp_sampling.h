#pragma once

#include <array>
#include <span>

#include "isophote/scene/emissive_triangles.h"
#include "isophote/scene/emitter.h"

namespace isophote {

/// A point of the triangle: uniform over its solid angle or, where all of it is about as far, over its area. The
/// density counts no choice of the triangle; 0: it does not shine there, from behind or in its own plane.
LightSample sample_lamp(const Scene& scene, const EmissiveTriangle& lamp, const Vec3& from, Vec2 u);

/// The density (solid angle) with which it gives the point `to`, which lies in `direction`.
float lamp_pdf(const EmissiveTriangle& lamp, const Vec3& from, const Vec3& to, const Vec3& direction);

/// Chooses among a few triangles by the light that each sends to a point where nothing is in its way and no surface
/// turned aside: its mean radiance times its solid angle, nearly. A tenth of the choice goes to all that shine there
/// alike.
class LampChoice {
 public:
  static constexpr std::size_t most = 32;

  /// As many triangles as radiances, `most` at most.
  LampChoice(std::span<const EmissiveTriangle> lamps, std::span<const float> mean_radiances, const Vec3& from);

  /// Does none shine there?
  bool empty() const { return !(chances_sum_ > 0); }
  /// An index, for u in [0, 1], or that of the last that shines there. Not on an empty one.
  std::uint32_t sample(float u) const;
  float chance(std::uint32_t i) const { return chances_[i] / chances_sum_; }

 private:
  std::array<float, most> chances_;  // of the first count_, up to a factor
  float chances_sum_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace isophote
