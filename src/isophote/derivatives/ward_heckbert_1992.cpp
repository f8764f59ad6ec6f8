#include "isophote/derivatives/ward_heckbert_1992.h"

#include <numbers>

#include "isophote/core/check.h"
#include "isophote/derivatives/standard_error.h"
#include "isophote/derivatives/tangent.h"
#include "isophote/derivatives/wall_step.h"

namespace isophote {
namespace {

constexpr double half_turn = std::numbers::pi;

double rotation_weight(const Strata& s, int j, RotationWeights weights) {
  if (weights == RotationWeights::classical) {
    const double sin2 = (j + 0.5) / s.polar;
    return half_turn / s.size() * std::sqrt(sin2 / (1 - sin2));
  }
  const double inner = s.theta_edge(j), outer = s.theta_edge(j + 1);
  return 2 * std::sin(half_turn / s.azimuthal) *
         ((outer - inner) / 2 - (std::sin(2 * outer) - std::sin(2 * inner)) / 4);
}

}  // namespace

Gradient<Rgb> rotational_gradient(const HemisphereGather& gather, RotationWeights weights) {
  const Strata& s = gather.strata;
  std::vector<Rgbd> by_azimuth(s.azimuthal);
  for (int j = 0; j < s.polar; ++j) {
    const double weight = rotation_weight(s, j, weights);
    for (int k = 0; k < s.azimuthal; ++k) by_azimuth[k] += Rgbd(gather.at(j, k).radiance) * weight;
  }
  TangentGradient result;
  for (int k = 0; k < s.azimuthal; ++k) result.add_across(azimuth(s, k + 0.5), by_azimuth[k]);
  return result.to_world(gather.frame);
}

namespace {

Rgbd step(const GatherSample& from, const GatherSample& to, WallDistance distance) {
  return wall_step(from, to, inverse_wall_distance(from, to, distance));
}

Gradient<Rgb> translational_gradient(const HemisphereGather& gather, WallDistance distance) {
  const Strata& s = gather.strata;
  TangentGradient result;
  for (int k = 0; k < s.azimuthal; ++k) {
    const int before = (k + s.azimuthal - 1) % s.azimuthal;
    Rgbd outward, across;
    for (int j = 0; j < s.polar; ++j) {
      const GatherSample& here = gather.at(j, k);
      const double sin_inner = s.sin_edge(j), cos_inner = s.cos_edge(j);
      if (j > 0) outward += step(gather.at(j - 1, k), here, distance) * (sin_inner * cos_inner * cos_inner);
      across += step(gather.at(j, before), here, distance) * (s.sin_edge(j + 1) - sin_inner);
    }
    result.add(azimuth(s, k + 0.5), outward * (2 * half_turn / s.azimuthal));
    result.add_across(azimuth(s, k), across);
  }
  return result.to_world(gather.frame);
}

}  // namespace

Jet<Rgb> irradiance(const HemisphereGather& gather) {
  ISOPHOTE_CHECK(gather.samples.size(), ==, static_cast<std::size_t>(gather.strata.size()));
  Rgbd sum;
  double inverse_distances = 0;
  for (const GatherSample& sample : gather.samples) {
    sum += Rgbd(sample.radiance);
    inverse_distances += 1 / static_cast<double>(sample.distance);
  }
  const double n = gather.strata.size();
  Jet<Rgb> jet;
  jet.value = Rgb(sum * (half_turn / n));
  jet.standard_error = static_cast<float>(standard_error(gather));
  jet.rays = static_cast<std::uint32_t>(gather.samples.size());
  jet.distances.harmonic_mean = static_cast<float>(n / inverse_distances);
  jet.distances.obstacles = obstacles(gather);
  return jet;
}

Jet<Rgb> ward_heckbert_1992(const HemisphereGather& gather, RotationWeights weights, WallDistance distance) {
  Jet<Rgb> jet = irradiance(gather);
  jet.translational = translational_gradient(gather, distance);
  jet.rotational = rotational_gradient(gather, weights);
  return jet;
}

}  // namespace isophote
