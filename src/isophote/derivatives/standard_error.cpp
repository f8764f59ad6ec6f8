#include "isophote/derivatives/standard_error.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace isophote {

std::span<const double> stratum_variances(const HemisphereGather& gather) {
  thread_local std::vector<double> seen;
  seen.clear();
  for (const GatherSample& sample : gather.samples) seen.push_back(luminance(Rgbd(sample.radiance)));
  return stratum_variances(seen, gather.strata.polar, gather.strata.azimuthal);
}

std::span<const double> stratum_variances(std::span<const double> seen, int polar, int azimuthal) {
  thread_local std::vector<double> variances;
  variances.clear();
  const auto n = static_cast<std::size_t>(azimuthal), rings = static_cast<std::size_t>(polar);
  const auto half_square = [](double difference) { return difference * difference / 2; };
  for (std::size_t j = 0; j < rings; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      const double here = seen[j * n + k];
      double sum = half_square(seen[j * n + (k + 1) % n] - here) + half_square(seen[j * n + (k + n - 1) % n] - here);
      int neighbours = 2;
      if (rings > 1) {
        const std::size_t ring = j + 1 < rings ? j + 1 : j - 1;
        sum += half_square(seen[ring * n + k] - here), ++neighbours;
      }
      variances.push_back(sum / neighbours);
    }
  return variances;
}

double standard_error(const HemisphereGather& gather) {
  double variance = 0;
  for (const double v : stratum_variances(gather)) variance += v;
  return std::numbers::pi / gather.strata.size() * std::sqrt(variance);
}

}  // namespace isophote
