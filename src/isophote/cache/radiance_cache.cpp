#include "isophote/cache/radiance_cache.h"

#include <cmath>

namespace isophote {

int RadianceCache::bands(const RadianceRecord& record) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<float>(record.jet.value.size()))));
}

Rgb reflected(const RadianceRecord& record, const Frame& frame, const Vec3& d, const Lobe& lobe, Vec2 viewer) {
  const Coefficients &value = record.jet.value, &by_u = record.jet.translational.x, &by_v = record.jet.translational.y;
  const bool flat = record.footprint.order == 0 || by_u.empty();
  const float du = dot(d, frame.u) * record.gradient_scale, dv = dot(d, frame.v) * record.gradient_scale;
  const auto radiance = [&](int i) { return flat ? value[i] : value[i] + by_u[i] * du + by_v[i] * dv; };
  const float size = std::sqrt(viewer.x * viewer.x + viewer.y * viewer.y);
  const float cos_phi = size > 0 ? viewer.x / size : 1, sin_phi = size > 0 ? viewer.y / size : 0;
  Rgb sum;
  for (int l = 0; l < lobe.order; ++l) sum += lobe.coefficients[polar_index(l, 0)] * radiance(harmonic_index(l, 0));
  float c = cos_phi, s = sin_phi;  // of m times the azimuth
  for (int m = 1; m < lobe.order; ++m) {
    for (int l = m; l < lobe.order; ++l)
      sum += lobe.coefficients[polar_index(l, m)] *
             (radiance(harmonic_index(l, m)) * c + radiance(harmonic_index(l, -m)) * s);
    const float next = c * cos_phi - s * sin_phi;
    s = s * cos_phi + c * sin_phi;
    c = next;
  }
  return max(sum, Rgb{});
}

}  // namespace isophote
