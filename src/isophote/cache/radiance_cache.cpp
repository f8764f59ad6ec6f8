#include "isophote/cache/radiance_cache.h"

#include <cmath>

namespace isophote {

int RadianceCache::bands(const RadianceRecord& record) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<float>(record.jet.value.size()))));
}

void apply_window(Lobe& lobe) {
  for (int l = 1; l < lobe.order; ++l) {
    const float kept = (1 + std::cos(pi * static_cast<float>(l) / static_cast<float>(lobe.order))) / 2;
    for (int m = 0; m <= l; ++m) lobe.coefficients[polar_index(l, m)] *= kept;
  }
}

TurnedLobe::TurnedLobe(const Lobe& lobe, Vec2 viewer) : order_(lobe.order) {
  const float size = std::sqrt(viewer.x * viewer.x + viewer.y * viewer.y);
  const float cos_phi = size > 0 ? viewer.x / size : 1, sin_phi = size > 0 ? viewer.y / size : 0;
  for (int l = 0; l < order_; ++l) coefficients_[harmonic_index(l, 0)] = lobe.coefficients[polar_index(l, 0)];
  float c = cos_phi, s = sin_phi;  // of m times the azimuth
  for (int m = 1; m < order_; ++m) {
    for (int l = m; l < order_; ++l) {
      const Rgb& straight = lobe.coefficients[polar_index(l, m)];
      coefficients_[harmonic_index(l, m)] = straight * c, coefficients_[harmonic_index(l, -m)] = straight * s;
    }
    const float next = c * cos_phi - s * sin_phi;
    s = s * cos_phi + c * sin_phi;
    c = next;
  }
}

Rgb reflected(const RadianceRecord& record, Vec2 across, const TurnedLobe& lobe) {
  const Gradient<Coefficients>& slope = record.jet.translational;
  const bool flat = record.footprint.order == 0 || slope.x.empty();
  const Rgb* value = record.jet.value.data();
  const Rgb *by_u = flat ? value : slope.x.data(), *by_v = flat ? value : slope.y.data();
  const float du = flat ? 0 : across.x * record.gradient_scale, dv = flat ? 0 : across.y * record.gradient_scale;
  // As many sums as a vector register or two has lanes, for one would wait for itself.
  constexpr int lanes = 8;
  std::array<Rgb, lanes> sums{};
  const Rgb* coefficients = lobe.coefficients();
  const int count = harmonics_count(lobe.order());
  const auto add = [&](Rgb& sum, int i) { sum += coefficients[i] * (value[i] + by_u[i] * du + by_v[i] * dv); };
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int k = 0; k < lanes; ++k) add(sums[k], i + k);
  for (; i < count; ++i) add(sums[0], i);
  Rgb sum;
  for (const Rgb& each : sums) sum += each;
  return sum;
}

}  // namespace isophote
