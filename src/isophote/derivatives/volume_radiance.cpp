#include "isophote/derivatives/volume_radiance.h"

#include "isophote/core/check.h"
#include "isophote/derivatives/standard_error.h"
#include "isophote/derivatives/volume_sum.h"

namespace isophote {
// A piece of surface is seen under the solid angle cos_y dA / r^2, a piece of a medium under dV / r^2: as the record
// moves, the first changes by (3 w + n_y / cos_y) / r of itself, the second by 2 w / r. The integral over the volume
// has its end at the record: there the source itself is what the ball of places around it gains and loses.
RaySum::RaySum(const SphereGather& gather, std::size_t sample, VolumePart part)
    : direction(Vec3d(gather.samples[sample].direction)) {
  const LayerRange range(gather, part);
  const GatherLayer* layers = &gather.layers[sample * static_cast<std::size_t>(gather.shells + 1)];
  for (int l = range.first; l < range.last; ++l) {
    if (is_black(layers[l].radiance)) continue;
    const Rgbd light(layers[l].radiance);
    radiance += light;
    over_depth += light / static_cast<double>(layers[l].depth);
    add(emitted, times(layers[l].log_gradient, light), 1);
  }
  if (part == VolumePart::media) {
    add(emitted, direction, -Rgbd(gather.sources[sample]));
    fixed = emitted;
    add(fixed, direction, 2 * over_depth);
    return;
  }
  fixed = emitted;
  const Vec3d normal(gather.samples[sample].normal);
  // Seen edge-on, as the limbs of round things are, a piece would count without bounds.
  const Vec3d tilt = normal / std::max(0.05, -dot(normal, direction));
  add(fixed, 3 * direction + tilt, over_depth);
}

VolumeJet unweighed_jet(const SphereGather& gather, VolumePart part) {
  ISOPHOTE_CHECK(gather.samples.size(), ==, static_cast<std::size_t>(gather.strata.size()));
  ISOPHOTE_CHECK(gather.layers.size(), ==, gather.samples.size() * static_cast<std::size_t>(gather.shells + 1));
  ISOPHOTE_CHECK(gather.sources.size(), ==, gather.samples.size());
  VolumeJet jet;
  const double n = gather.strata.size();
  double value = 0, gradient = 0, inverse_distances = 0;
  std::vector<double> seen;
  seen.reserve(gather.samples.size());
  for (std::size_t i = 0; i < gather.samples.size(); ++i) {
    const RaySum ray(gather, i, part);
    seen.push_back(luminance(ray.radiance));
    value += seen.back() / n;
    gradient += length(luminance_of(ray.fixed)) / n;
    inverse_distances += 1 / static_cast<double>(gather.samples[i].distance);
  }
  jet.obstacles = obstacles(gather);
  jet.value_sum = static_cast<float>(value), jet.gradient_sum = static_cast<float>(gradient);
  double variance = 0;
  for (const double v : stratum_variances(seen, gather.strata.polar, gather.strata.azimuthal)) variance += v;
  jet.standard_error = static_cast<float>(std::sqrt(variance) / n);
  jet.rays = static_cast<std::uint32_t>(gather.samples.size());
  jet.distances.harmonic_mean = static_cast<float>(n / inverse_distances);
  return jet;
}

void store(VolumeJet& jet, std::span<const WeighedRadiance> coefficients) {
  for (const WeighedRadiance& c : coefficients) {
    jet.value.push_back(Rgb(c.value));
    jet.translational.x.push_back(Rgb(c.gradient.x));
    jet.translational.y.push_back(Rgb(c.gradient.y));
    jet.translational.z.push_back(Rgb(c.gradient.z));
  }
}

VolumeJet volume_radiance(const SphereGather& gather, VolumePart part, int order) {
  VolumeJet jet = unweighed_jet(gather, part);
  const HarmonicWeights weights{order};
  std::vector<Rgbd> sums(static_cast<std::size_t>(weights.count()));
  WeightsThere there;
  for (std::size_t i = 0; i < gather.samples.size(); ++i) {
    const RaySum ray(gather, i, part);
    if (is_black(ray.radiance)) continue;
    weights(ray.direction, there.values);
    for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += ray.radiance * (there.values[b] * cell_size(gather));
  }
  jet.value = Coefficients(sums.begin(), sums.end());
  return jet;
}

}  // namespace isophote
