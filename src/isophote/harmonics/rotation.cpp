#include "isophote/harmonics/rotation.h"

#include <cstdlib>

#include "isophote/core/check.h"

namespace isophote {

HarmonicRotation::HarmonicRotation(int order, const Framed& frame) : order_(order) {
  ISOPHOTE_CHECK(order, <=, most_order);
  bands_.assign(static_cast<std::size_t>(begin(order)), 0);
  if (order > 0) bands_[0] = 1;
  if (order < 2) return;
  // Functions of band 1 are proportional to y, z and x.
  const Vec3d columns[] = {frame.v, frame.n, frame.u};
  for (int m = -1; m <= 1; ++m)
    for (int n = -1; n <= 1; ++n) {
      const Vec3d& turned = columns[n + 1];
      bands_[begin(1) + (m + 1) * 3 + n + 1] = m < 0 ? turned.y : m == 0 ? turned.z : turned.x;
    }
  for (int l = 2; l < order; ++l)
    for (int m = -l; m <= l; ++m)
      for (int n = -l; n <= l; ++n) bands_[begin(l) + (m + l) * (2 * l + 1) + n + l] = element(l, m, n);
}

/// P of the paper's second table: of band 1 and band l - 1.
double HarmonicRotation::product(int i, int l, int a, int b) const {
  const auto below = [&](int m, int n) { return at(l - 1, m, n); };
  if (b == -l) return at(1, i, 1) * below(a, -l + 1) + at(1, i, -1) * below(a, l - 1);
  if (b == l) return at(1, i, 1) * below(a, l - 1) - at(1, i, -1) * below(a, -l + 1);
  return at(1, i, 0) * below(a, b);
}

/// u U + v V + w W, in the form of the published errata.
double HarmonicRotation::element(int l, int m, int n) const {
  const int k = std::abs(m);
  const double below = std::abs(n) == l ? 2.0 * l * (2 * l - 1) : static_cast<double>(l + n) * (l - n);
  double sum = 0;
  if (k < l) sum += std::sqrt((l + m) * (l - m) / below) * product(0, l, m, n);
  if (m == 0) return sum - std::sqrt(2.0 * (l - 1) * l / below) / 2 * (product(1, l, 1, n) + product(-1, l, -1, n));
  const double v = std::sqrt((l + k - 1.0) * (l + k) / below) / 2, root = k == 1 ? std::sqrt(2.0) : 1.0;
  if (m > 0) {
    sum += v * (product(1, l, m - 1, n) * root - (k == 1 ? 0 : product(-1, l, 1 - m, n)));
  } else {
    sum += v * ((k == 1 ? 0 : product(1, l, m + 1, n)) + product(-1, l, -m - 1, n) * root);
  }
  const double w = -std::sqrt((l - k - 1.0) * (l - k) / below) / 2;
  if (w != 0)
    sum += m > 0 ? w * (product(1, l, m + 1, n) + product(-1, l, -m - 1, n))
                 : w * (product(1, l, m - 1, n) - product(-1, l, 1 - m, n));
  return sum;
}

}  // namespace isophote
