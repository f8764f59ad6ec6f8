#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "isophote/derivatives/gather.h"

namespace isophote {

/// The sphere cut into `polar` rings of equal solid angle, each cut into `azimuthal` cells: cell (j, k) holds
/// cos(theta) in 1 - 2 [j, j + 1] / M and phi in 2 pi [k, k + 1] / N, in world space about z. Samples are stored ring
/// by ring: index j * N + k.
struct SphereStrata {
  int polar = 0;      ///< M
  int azimuthal = 0;  ///< N

  int size() const { return polar * azimuthal; }
  bool operator==(const SphereStrata&) const = default;

  /// cos(theta) between rings j - 1 and j, for j in [0, M].
  double cos_edge(int j) const { return 1 - 2.0 * j / polar; }
  double azimuth(double k) const { return 2 * std::numbers::pi * k / azimuthal; }
  /// The direction of cell (j, k) at `u` in the unit square.
  Vec3 direction(int j, int k, Vec2 u) const {
    const double z = cos_edge(j) - 2.0 * static_cast<double>(u.x) / polar, phi = azimuth(k + static_cast<double>(u.y));
    const double s = std::sqrt(std::max(0.0, 1 - z * z));
    return Vec3(Vec3d(s * std::cos(phi), s * std::sin(phi), z));
  }
};

/// What a record in a medium sees: one sample per stratum of the sphere about `position`, with its layers.
struct SphereGather {
  Vec3 position;
  SphereStrata strata;
  int shells = 0;
  std::vector<float> shell_ends;      ///< depths at which shells end, ascending, as many as shells
  std::vector<GatherSample> samples;  ///< distance infinity: the sky
  std::vector<GatherLayer> layers;    ///< of each sample, the surface (index 0) and `shells` shells of depths
  std::vector<Rgb> sources;  ///< per sample: sigma_s times the in-scattered radiance at the record itself towards the
                             ///< record, of what its direction's first shell holds: the limit of radiance per depth

  const GatherSample& at(int j, int k) const { return samples[static_cast<std::size_t>(j) * strata.azimuthal + k]; }
  const GatherLayer& layer(int j, int k, int l) const {
    return layers[(static_cast<std::size_t>(j) * strata.azimuthal + k) * (shells + 1) + l];
  }
};

}  // namespace isophote
