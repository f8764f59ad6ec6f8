#pragma once

#include <span>
#include <vector>

#include "isophote/harmonics/basis.h"
#include "isophote/sampling/strata.h"

namespace isophote {

/// A basis over the strata of a hemisphere. Each function is a part of theta, by `polar_index`, times a part of phi
/// (cos and sin with their factors), by `azimuth_index`; here are what sums over strata need of both: integrals over
/// cells and along the walls between them.
class StrataHarmonics {
 public:
  StrataHarmonics(Basis basis, int order, const Strata& strata);

  Basis basis() const { return basis_; }
  int order() const { return order_; }
  const Strata& strata() const { return strata_; }

  int azimuths() const { return 2 * order_ - 1; }
  int azimuth_index(int m) const { return m + order_ - 1; }

  /// Of theta over ring j: in sin(theta) d(theta), times sin(theta), in d(theta); and the value between rings j - 1 and
  /// j.
  std::span<const double> over_ring(int j) const { return row(over_ring_, j, polar_count(order_)); }
  std::span<const double> sin_over_ring(int j) const { return row(sin_over_ring_, j, polar_count(order_)); }
  std::span<const double> along_ring(int j) const { return row(along_ring_, j, polar_count(order_)); }
  std::span<const double> between_rings(int j) const { return row(between_rings_, j, polar_count(order_)); }
  /// Of phi over cell k: alone, times cos(phi), times sin(phi), in d(phi); and the value between cells k - 1 and k.
  std::span<const double> over_cell(int k) const { return row(over_cell_, k, azimuths()); }
  std::span<const double> cos_over_cell(int k) const { return row(cos_over_cell_, k, azimuths()); }
  std::span<const double> sin_over_cell(int k) const { return row(sin_over_cell_, k, azimuths()); }
  std::span<const double> between_cells(int k) const { return row(between_cells_, k, azimuths()); }

  /// Adds, for each function, its part of theta times what `by_azimuth` holds for its part of phi.
  template <class T>
  void add(std::span<const double> polar, std::span<const T> by_azimuth, std::span<T> sums) const {
    for (int l = 0; l < order_; ++l)
      for (int m = -l; m <= l; ++m)
        sums[harmonic_index(l, m)] += by_azimuth[azimuth_index(m)] * polar[polar_index(l, m < 0 ? -m : m)];
  }

 private:
  void set_polar();
  void set_azimuths();
  static std::span<const double> row(const std::vector<double>& table, int index, int width) {
    return std::span(table).subspan(static_cast<std::size_t>(index) * width, width);
  }

  Basis basis_;
  int order_;
  Strata strata_;
  std::vector<double> over_ring_, sin_over_ring_, along_ring_, between_rings_;
  std::vector<double> over_cell_, cos_over_cell_, sin_over_cell_, between_cells_;
};

/// In memory of the calling thread, which its next call for other strata reuses.
const StrataHarmonics& strata_harmonics(Basis basis, int order, const Strata& strata);

}  // namespace isophote
