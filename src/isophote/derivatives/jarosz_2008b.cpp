#include "isophote/derivatives/jarosz_2008b.h"

#include <numbers>

#include "isophote/core/check.h"
#include "isophote/derivatives/layer_step.h"
#include "isophote/derivatives/tangent.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {
namespace {

class LayeredHemisphere {
 public:
  LayeredHemisphere(const HemisphereGather& gather, WallDistance distance)
      : gather_(gather),
        distance_(distance),
        frame_(gather.frame),
        layers_(static_cast<std::size_t>(gather.shells) + 1) {
    ISOPHOTE_CHECK(gather.layers.size(), ==, gather.samples.size() * layers_);
  }

  /// Over the walls, as ward_heckbert_1992.
  void add_walls(TangentGradient& sum) const {
    const Strata& s = gather_.strata;
    for (int k = 0; k < s.azimuthal; ++k) {
      const int before = (k + s.azimuthal - 1) % s.azimuthal;
      Rgbd outward, across;
      for (int j = 0; j < s.polar; ++j) {
        const double sin_inner = s.sin_edge(j), cos_inner = s.cos_edge(j);
        if (j > 0) outward += step(j - 1, k, j, k) * (sin_inner * cos_inner * cos_inner);
        across += step(j, before, j, k) * (s.sin_edge(j + 1) - sin_inner);
      }
      sum.add(azimuth(s, k + 0.5), outward * (2 * std::numbers::pi / s.azimuthal));
      sum.add_across(azimuth(s, k), across);
    }
  }

  /// Along the rays: of what light loses on its way, of what it is at its source towards the record, and of where the
  /// media begin, at the record itself.
  void add_rays(TangentGradient& sum) const {
    const double share = std::numbers::pi / gather_.strata.size();
    for (std::size_t i = 0; i < gather_.samples.size(); ++i) {
      for (const GatherLayer& layer : layers_of(i)) {
        if (is_black(layer.radiance)) continue;
        const Rgbd light = Rgbd(layer.radiance) * share;
        sum.u += light * along(layer.log_gradient, frame_.u), sum.v += light * along(layer.log_gradient, frame_.v);
      }
      if (gather_.sources.empty()) continue;
      const Vec3d w = frame_.to_local(Vec3d(gather_.samples[i].direction));
      const Rgbd source = Rgbd(gather_.sources[i]) * share;
      sum.u -= source * w.x, sum.v -= source * w.y;
    }
  }

 private:
  static Rgbd along(const Gradient<Rgb>& g, const Vec3d& axis) {
    return Rgbd(g.x) * axis.x + Rgbd(g.y) * axis.y + Rgbd(g.z) * axis.z;
  }
  std::span<const GatherLayer> layers_of(std::size_t i) const {
    return std::span(gather_.layers).subspan(i * layers_, layers_);
  }
  LayeredSample at(int j, int k) const {
    const auto i = static_cast<std::size_t>(j) * gather_.strata.azimuthal + k;
    return {gather_.samples[i], layers_of(i)};
  }
  Rgbd step(int j, int k, int to_j, int to_k) const {
    return layer_steps(at(j, k), at(to_j, to_k), 0, layers_, distance_);
  }

  const HemisphereGather& gather_;
  WallDistance distance_;
  Framed frame_;
  std::size_t layers_;
};

}  // namespace

Jet<Rgb> jarosz_2008b(const HemisphereGather& gather, WallDistance distance) {
  if (gather.layers.empty()) return ward_heckbert_1992(gather, RotationWeights::exact, distance);
  Jet<Rgb> jet = irradiance(gather);
  TangentGradient sum;
  const LayeredHemisphere hemisphere(gather, distance);
  hemisphere.add_walls(sum);
  hemisphere.add_rays(sum);
  jet.translational = sum.to_world(gather.frame);
  jet.rotational = rotational_gradient(gather, RotationWeights::exact);
  return jet;
}

}  // namespace isophote
