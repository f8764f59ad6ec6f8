#pragma once

#include "isophote/derivatives/layer_step.h"
#include "isophote/derivatives/volume_sum.h"

namespace isophote {

/// Radiance in a medium with its gradient by moving walls (docs/theory.md): what [Ward, Heckbert 1992] and
/// [Jarosz 2008b] do over the hemisphere, over the sphere. Radiance steps over the walls between cells, layer by layer,
/// at the depth of each, and light changes on its way as the record moves. Knows occlusion.
VolumeJet moving_walls(const SphereGather& gather, VolumePart part, int order,
                       WallDistance distance = WallDistance::refined);

/// The walls of a gather's cells, with what radiance steps by over each, over its distance.
class SphereWalls {
 public:
  SphereWalls(const SphereGather& gather, VolumePart part, WallDistance distance);

  /// Calls visit(direction of the wall's middle, normal times length, step) for each wall.
  template <class Visit>
  void for_each(Visit&& visit) const {
    const SphereStrata& s = gather_.strata;
    const double turn = s.azimuth(1);
    // Over its length the normal of a wall between rings turns: this is the mean of its part across z.
    const double shortened = std::sin(turn / 2) / (turn / 2);
    for (int j = 0; j < s.polar; ++j) {
      const double z = s.cos_edge(j), r = root(z), z_middle = (z + s.cos_edge(j + 1)) / 2, r_middle = root(z_middle);
      const double height = std::acos(s.cos_edge(j + 1)) - std::acos(z);
      for (int k = 0; k < s.azimuthal; ++k) {
        const double middle = s.azimuth(k + 0.5), c = std::cos(middle), n = std::sin(middle);
        if (j > 0)
          visit(Vec3d{r * c, r * n, z}, Vec3d{shortened * z * c, shortened * z * n, -r} * (r * turn),
                step(j - 1, k, j, k));
        const double start = s.azimuth(k), cs = std::cos(start), ns = std::sin(start);
        visit(Vec3d{r_middle * cs, r_middle * ns, z_middle}, Vec3d{-ns, cs, 0} * height,
              step(j, (k + s.azimuthal - 1) % s.azimuthal, j, k));
      }
    }
  }

 private:
  static double root(double z) { return std::sqrt(std::max(0.0, 1 - z * z)); }
  LayeredSample at(int j, int k) const;
  Rgbd step(int j, int k, int to_j, int to_k) const;

  const SphereGather& gather_;
  LayerRange range_;
  WallDistance distance_;
};

/// The same for any weights.
template <class Weights>
std::vector<WeighedRadiance> weigh_moving_walls(const SphereGather& gather, VolumePart part, const Weights& weights,
                                                WallDistance distance = WallDistance::refined) {
  std::vector<WeighedRadiance> sums(static_cast<std::size_t>(weights.count()));
  WeightsThere there;
  const double size = cell_size(gather);
  for (std::size_t i = 0; i < gather.samples.size(); ++i) {
    const RaySum ray(gather, i, part);
    weights(ray.direction, there.values);
    for (std::size_t b = 0; b < sums.size(); ++b) {
      sums[b].value += ray.radiance * (there.values[b] * size);
      add(sums[b].gradient, ray.emitted, there.values[b] * size);
    }
  }
  SphereWalls(gather, part, distance).for_each([&](const Vec3d& middle, const Vec3d& normal, const Rgbd& step) {
    if (is_black(step)) return;
    weights(middle, there.values);
    for (std::size_t b = 0; b < sums.size(); ++b) add(sums[b].gradient, normal * there.values[b], step);
  });
  return sums;
}

}  // namespace isophote
