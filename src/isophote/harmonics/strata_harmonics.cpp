#include "isophote/harmonics/strata_harmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "isophote/harmonics/quadrature.h"

namespace isophote {
namespace {

/// The angle of which the parts of theta are polynomials in cosine and sine, so that quadrature is exact: theta itself,
/// or that of the stretched cosine 2 cos(theta) - 1.
double smooth_angle(Basis basis, double cos_theta) {
  return 2 * std::asin(std::sqrt(basis == Basis::spherical ? (1 - cos_theta) / 2 : 1 - cos_theta));
}

/// Parts of theta at a smooth angle; with sin(theta), and sin(theta) d(theta) and d(theta) over d(angle) there.
struct Polar {
  std::array<double, polar_count(most_order)> values;
  double sine, area, length;

  Polar(Basis basis, int order, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const bool half = basis == Basis::hemispherical;
    evaluate_legendre(order, c, values);
    double power = half ? std::numbers::sqrt2 : 1;
    for (int m = 0; m < order; ++m, power *= s)
      for (int l = m; l < order; ++l) values[polar_index(l, m)] *= power;
    // At cos(theta) = cos^2(angle / 2), where sin(theta) d(theta) is sin(angle) d(angle) / 2.
    const double z = (1 + c) / 2;
    sine = half ? std::sqrt(std::max(0.0, 1 - z * z)) : s;
    area = half ? s / 2 : s;
    length = half ? std::sqrt(z / (1 + z)) : 1;
  }
};

}  // namespace

StrataHarmonics::StrataHarmonics(Basis basis, int order, const Strata& strata)
    : basis_(basis), order_(order), strata_(strata) {
  set_polar();
  set_azimuths();
}

void StrataHarmonics::set_polar() {
  const auto width = static_cast<std::size_t>(polar_count(order_)), rings = static_cast<std::size_t>(strata_.polar);
  for (std::vector<double>* table : {&over_ring_, &sin_over_ring_, &along_ring_}) table->assign(rings * width, 0);
  between_rings_.assign((rings + 1) * width, 0);
  const auto& rule = GaussRule<16>::get();
  for (std::size_t j = 0; j <= rings; ++j) {
    const double angle = smooth_angle(basis_, strata_.cos_edge(static_cast<int>(j)));
    const Polar edge(basis_, order_, angle);
    for (std::size_t i = 0; i < width; ++i) between_rings_[j * width + i] = edge.values[i];
    if (j == rings) break;
    const double outer = smooth_angle(basis_, strata_.cos_edge(static_cast<int>(j) + 1));
    const int pieces = 1 + static_cast<int>((outer - angle) / 0.8);  // of a width for which the rule is exact
    for (int piece = 0; piece < pieces; ++piece) {
      const double width_of_one = (outer - angle) / pieces, from = angle + piece * width_of_one;
      rule.integrate(from, from + width_of_one, [&](double at, double weight) {
        const Polar polar(basis_, order_, at);
        for (std::size_t i = 0; i < width; ++i) {
          over_ring_[j * width + i] += polar.values[i] * polar.area * weight;
          sin_over_ring_[j * width + i] += polar.values[i] * polar.area * polar.sine * weight;
          along_ring_[j * width + i] += polar.values[i] * polar.length * weight;
        }
      });
    }
  }
}

void StrataHarmonics::set_azimuths() {
  for (std::vector<double>* table : {&over_cell_, &cos_over_cell_, &sin_over_cell_, &between_cells_})
    table->assign(static_cast<std::size_t>(strata_.azimuthal) * azimuths(), 0);
  for (int k = 0; k < strata_.azimuthal; ++k) {
    const double from = strata_.azimuth(k), to = strata_.azimuth(k + 1);
    const auto cosine = [&](int n) { return n == 0 ? to - from : (std::sin(n * to) - std::sin(n * from)) / n; };
    const auto sine = [&](int n) { return n == 0 ? 0 : (std::cos(n * from) - std::cos(n * to)) / n; };
    for (int m = 1 - order_; m < order_; ++m) {
      const int n = std::abs(m);
      const auto at = static_cast<std::size_t>(k) * azimuths() + azimuth_index(m);
      const double factor = m == 0 ? 1 : std::numbers::sqrt2;
      if (m >= 0) {
        over_cell_[at] = factor * cosine(n), between_cells_[at] = factor * std::cos(n * from);
        cos_over_cell_[at] = factor * (cosine(n - 1) + cosine(n + 1)) / 2;
        sin_over_cell_[at] = factor * (sine(n + 1) - sine(n - 1)) / 2;
      } else {
        over_cell_[at] = factor * sine(n), between_cells_[at] = factor * std::sin(n * from);
        cos_over_cell_[at] = factor * (sine(n + 1) + sine(n - 1)) / 2;
        sin_over_cell_[at] = factor * (cosine(n - 1) - cosine(n + 1)) / 2;
      }
    }
  }
}

const StrataHarmonics& strata_harmonics(Basis basis, int order, const Strata& strata) {
  thread_local std::optional<StrataHarmonics> last;
  if (!last || last->basis() != basis || last->order() != order || last->strata() != strata)
    last.emplace(basis, order, strata);
  return *last;
}

}  // namespace isophote
