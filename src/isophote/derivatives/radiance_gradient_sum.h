#pragma once

#include <span>
#include <vector>

#include "isophote/derivatives/incident_radiance.h"
#include "isophote/harmonics/strata_harmonics.h"

namespace isophote {

/// What the strata of one ring add to the gradients along u and v, by the part of phi of the functions.
struct RadianceGradientRows {
  std::vector<Rgbd> u, v;

  explicit RadianceGradientRows(int azimuths) : u(azimuths), v(azimuths) {}
  void clear() { u.assign(u.size(), {}), v.assign(v.size(), {}); }

  /// `amount` times two rows of `StrataHarmonics`.
  void add(const Rgbd& amount, std::span<const double> along_u, std::span<const double> along_v) {
    for (std::size_t m = 0; m < u.size(); ++m) u[m] += amount * along_u[m], v[m] += amount * along_v[m];
  }
  /// Two amounts times one row.
  void add(const Rgbd& along_u, const Rgbd& along_v, std::span<const double> row) {
    for (std::size_t m = 0; m < u.size(); ++m) u[m] += along_u * row[m], v[m] += along_v * row[m];
  }
};

/// The gradients of all coefficients.
class RadianceGradientSum {
 public:
  explicit RadianceGradientSum(int order) : u_(harmonics_count(order)), v_(harmonics_count(order)) {}

  void add(const StrataHarmonics& h, std::span<const double> polar, const RadianceGradientRows& rows) {
    h.add<Rgbd>(polar, rows.u, u_), h.add<Rgbd>(polar, rows.v, v_);
  }
  void store(RadianceJet& jet) const {
    jet.translational.x = Coefficients(u_.begin(), u_.end());
    jet.translational.y = Coefficients(v_.begin(), v_.end());
  }

 private:
  std::vector<Rgbd> u_, v_;
};

}  // namespace isophote
