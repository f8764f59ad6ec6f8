#pragma once

#include <array>
#include <span>
#include <vector>

#include "isophote/derivatives/volume_radiance.h"
#include "isophote/harmonics/basis.h"

// What estimators of radiance in media have in common. Each is a template over the functions of direction that radiance
// is weighed by, `Weights`: any number of them, up to `most_weights`, with
//   int count() const;
//   void operator()(const Vec3d& w, std::span<double> values) const;
//   void operator()(const Vec3d& w, std::span<double> values, std::span<Vec3d> slopes) const;
// the slopes being gradients on the sphere at the unit vector w, away from the record.
namespace isophote {

inline constexpr int most_weights = harmonics_count(most_order);

struct HarmonicWeights {
  int order;

  int count() const { return harmonics_count(order); }
  void operator()(const Vec3d& w, std::span<double> values) const {
    evaluate_harmonics(Basis::spherical, order, w, values);
  }
  void operator()(const Vec3d& w, std::span<double> values, std::span<Vec3d> slopes) const {
    evaluate_harmonics(Basis::spherical, order, w, values, slopes);
  }
};

/// Where weights are written, by their number.
struct WeightsThere {
  std::array<double, most_weights> values;
  std::array<Vec3d, most_weights> slopes;
};

inline void add(Gradient<Rgbd>& g, const Gradient<Rgbd>& more, double times) {
  g.x += more.x * times, g.y += more.y * times, g.z += more.z * times;
}

inline Vec3d luminance_of(const Gradient<Rgbd>& g) { return {luminance(g.x), luminance(g.y), luminance(g.z)}; }
/// Of light, from the gradient of its logarithm.
inline Gradient<Rgbd> times(const Gradient<Rgb>& logarithmic, const Rgbd& light) {
  return {Rgbd(logarithmic.x) * light, Rgbd(logarithmic.y) * light, Rgbd(logarithmic.z) * light};
}

/// An integral over the sphere of radiance times one weight, and its gradient.
struct WeighedRadiance {
  Rgbd value;
  Gradient<Rgbd> gradient;
};

/// The layers of a part: [first, last).
struct LayerRange {
  int first, last;

  LayerRange(const SphereGather& gather, VolumePart part)
      : first(part == VolumePart::surfaces ? 0 : 1), last(part == VolumePart::surfaces ? 1 : gather.shells + 1) {}
};

/// The solid angle of a cell.
inline double cell_size(const SphereGather& gather) { return 4 * std::numbers::pi / gather.strata.size(); }

/// What one ray saw of a part, its layers summed.
struct RaySum {
  Vec3d direction;
  Rgbd radiance;
  Rgbd over_depth;         ///< of each layer's radiance over its depth
  Gradient<Rgbd> emitted;  ///< of radiance, places staying: by transmittance and by sources' dependence on direction,
                           ///< and what media lose where they begin, at the record itself
  Gradient<Rgbd> fixed;    ///< the same, and what comes of places' distance and tilt: all but the weight's own change

  RaySum(const SphereGather& gather, std::size_t sample, VolumePart part);
};

/// All of a jet that knows nothing of the weights: neither coefficients nor their derivatives.
VolumeJet unweighed_jet(const SphereGather& gather, VolumePart part);

/// And the coefficients.
void store(VolumeJet& jet, std::span<const WeighedRadiance> coefficients);

}  // namespace isophote
