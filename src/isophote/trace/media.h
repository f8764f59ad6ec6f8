#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "isophote/core/gradient.h"
#include "isophote/core/ray.h"
#include "isophote/sampling/sampler.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// A point at which a medium scatters.
struct MediumPoint {
  Vec3 position;
  float g = 0;  ///< of the medium's phase function
  std::uint32_t medium = 0;
  Rgb inside;  ///< sigma_a (1/m) of the solid that it lies in, as SurfacePoint::medium
};

/// The media of a scene as rays meet them. Safe to use from any number of threads.
class Media {
 public:
  /// `scene` must outlive this.
  explicit Media(const Scene& scene);
  ~Media();
  Media(Media&&) noexcept;

  /// Bit i: the i-th medium's bounds hold `p`.
  std::uint32_t holding(const Vec3& p) const;
  /// The box about the bounds of all.
  Box bounds() const;
  /// The shortest part of a ray that has all that lies in media; near not below far where nothing does.
  Ray within(const Ray& ray) const;
  /// The largest |g| of media, by their bits.
  float anisotropy(std::uint32_t media) const;

  /// One of the media that scatter at `p`, chosen by how much they do, with sigma_s (1/m) over the chance of the
  /// choice: for one medium, its own. None where nothing scatters.
  struct Scatterer {
    MediumPoint point;
    Rgb scattering;
  };
  std::optional<Scatterer> scatterer(const Vec3& p, float u) const;
  /// sigma_t of all media at `p`, 1/m.
  Rgb extinction(const Vec3& p) const;

  /// What media emit at `p`, W/m3/sr.
  Rgb emission(const Vec3& p) const;

  /// Points along a ray at which it is worth looking for scattered or emitted light, chosen with a density near to what
  /// is seen from there, scattering times transmittance: one by each `count`-th part of the chance, by a number of
  /// `sampler`. An integral along the ray is the sum of length times what the point's medium adds to the integrand. The
  /// span is overwritten by the thread's next call.
  struct RayPoint {
    float distance = 0, length = 0;
    MediumPoint point;
    Rgb scattering;  ///< sigma_s of the medium there, 1/m
    Rgb emission;    ///< and what it emits, W/m3/sr
  };
  std::span<const RayPoint> sample_points(const Ray& ray, int count, Sampler& sampler) const;
  /// The same, one in each of the parts that `ends`, ascending, cut the ray into from its near end on; of length 0
  /// where there is nothing to look for.
  std::span<const RayPoint> sample_parts(const Ray& ray, std::span<const float> ends, Sampler& sampler) const;

  /// Where light that comes along the ray (ray.near to ray.far, finite or not) was scattered last: the free flight is
  /// chosen by delta tracking [Woodcock 1965] against bounds of the density, with the probabilities of [Kutz 2017]
  /// where channels differ. `throughput` becomes what scales the light from there, or from ray.far where nothing
  /// scattered; what media emit along the way, so scaled, is added to `emission`. Unbiased.
  std::optional<MediumPoint> collide(const Ray& ray, Sampler& sampler, Rgb& throughput, Rgb& emission) const;

  /// The share of light that passes from ray.near to ray.far: an unbiased estimate where densities are grids (ratio
  /// tracking [Novak 2014], its random numbers from `seed`), exact otherwise.
  Rgb transmittance(const Ray& ray, std::uint32_t seed) const;

  /// What passes from `depths` along the ray, ascending and finite or not, to its origin: not sampled, grids cell by
  /// cell.
  struct Passage {
    Rgb transmittance{1.0f};
    Gradient<Rgb> log_gradient;  ///< of the transmittance's logarithm as the origin moves and the far end stays, 1/m
  };
  void along(const Ray& ray, std::span<const float> depths, std::span<Passage> passages) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace isophote
