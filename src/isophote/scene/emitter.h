#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isophote/sampling/distribution.h"
#include "isophote/scene/scene.h"
#include "isophote/scene/surface.h"

namespace isophote {

/// A direction towards a light, from a point.
struct LightSample {
  Vec3 direction;
  float distance = infinity;
  Rgb radiance;   ///< that arrives, unoccluded; for a delta light: irradiance at normal incidence
  float pdf = 0;  ///< solid angle, the chance of choosing this emitter included; for a delta light only that chance
  bool delta = false;
  bool sampled_directly = true;
  Vec3 end{};  ///< where a shadow ray ends, for a finite distance: at the light, off its triangle on the side of `from`
};

/// Which punctual lights are meant: those that have a place are point and spot lights.
enum class PunctualKinds : std::uint8_t { all, directional, placed };
class PunctualLights;

/// All that emits. Emissive triangles (textures averaged over them) and the environment are chosen by power, with a
/// tenth of the choice to all alike; triangles, where they are few, among themselves by what they may send to the point
/// (`choose_lamp`). The environment is split in two: its peaks (all sun-like texels together) and the rest. Punctual
/// lights are sampled beside them, by themselves. Lamps, punctual lights and peaks are `sampled_directly`: their light
/// scattered once is direct light. The rest of the environment is not: it is seen by gathers and cached. Never both.
/// The rest is chosen with a chance of at most 1/2 beside others: power cannot know how much of the sky is hidden, and
/// rays chosen by the BSDF find it too.
class Emitters {
 public:
  /// What `sample` chooses among.
  enum class Among : std::uint8_t { all, sampled_directly };

  /// Emissive triangles, and punctual lights: of the 2^24 numbers that the choice is made with, a twentieth (a
  /// tenth, the rest of the environment taking half of all) must leave one to each.
  static constexpr std::size_t most = 3 << 18;

  /// `scene` must outlive this. Throws UserError, which names no file, where the scene has more than `most`.
  explicit Emitters(const Scene& scene);

  /// Is there nothing for `sample` to choose from?
  bool empty(Among among = Among::all) const;
  /// One triangle or point of the environment and the direction towards it; pdf 0 where the emitter does not shine on
  /// `from` at all. `empty` must not hold.
  LightSample sample(const Vec3& from, float u_choice, Vec2 u, Among among = Among::all) const;
  /// The punctual lights. Their light and that of `sample` add up.
  const PunctualLights& punctual(PunctualKinds kinds) const;

  /// The density (solid angle) with which `sample` gives the direction in which the triangle of `hit` was met. Above 0
  /// wherever the triangle shines on `from`.
  float triangle_pdf(const Hit& hit, const Vec3& from, const Vec3& direction, Among among = Among::all) const;
  float environment_pdf(const Vec3& direction, Among among = Among::all) const;

  struct Sky {
    Rgb radiance;
    bool sampled_directly = false;
  };
  Sky environment(const Vec3& direction) const;

  /// Is `from` so near to an emissive triangle that light sampling alone would be noisy there, so that a ray chosen by
  /// the BSDF should share the work? True at least wherever a cosine-distributed ray could meet an emitter with four
  /// times the density of `sample(..., sampled_directly)` if that chose by power alone. False means: sampling lights
  /// has bounded variance and its weight may be 1.
  bool near(const Vec3& from) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace isophote
