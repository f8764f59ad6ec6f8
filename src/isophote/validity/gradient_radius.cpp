#include "isophote/validity/gradient_radius.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isophote {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

float sum_of_squares(const Coefficients& all, int channel) {
  float sum = 0;
  for (const Rgb& c : all) sum += c[channel] * c[channel];
  return sum;
}

}  // namespace

float gradient_radius(const Jet<Rgb>& jet) {
  float radius = infinite;
  for (int c = 0; c < 3; ++c) {
    const Vec3 g{jet.translational.x[c], jet.translational.y[c], jet.translational.z[c]};
    const float steepness = length(g);
    if (steepness > 0) radius = std::min(radius, jet.value[c] / steepness);
  }
  return radius;
}

float gradient_radius(const RadianceJet& jet) {
  float radius = infinite;
  for (int c = 0; c < 3; ++c) {
    const auto& [x, y, z] = jet.translational;
    const float steepness = std::sqrt(sum_of_squares(x, c) + sum_of_squares(y, c) + sum_of_squares(z, c));
    if (steepness > 0) radius = std::min(radius, std::sqrt(sum_of_squares(jet.value, c)) / steepness);
  }
  return radius;
}

}  // namespace isophote
