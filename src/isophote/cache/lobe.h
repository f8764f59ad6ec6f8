#pragma once

#include <array>

#include "isophote/core/rgb.h"
#include "isophote/harmonics/basis.h"

namespace isophote {

/// A glossy lobe towards one viewer, for incident directions in the surface's frame with the viewer at azimuth 0: bsdf
/// times the cosine, as coefficients of the cache's basis. Being even in azimuth it has those of m >= 0 alone, by
/// `polar_index`; only those of the first `order` bands are set. Its product with incident radiance, summed over all,
/// is the radiance reflected.
struct Lobe {
  int order;
  std::array<Rgb, polar_count(most_order)> coefficients;
};

/// Hanning's window: the later a band, the less of it counts, so that a lobe that is cut off does not ring. What a lobe
/// makes of light that is the same from everywhere stays.
void apply_window(Lobe& lobe);

/// A lobe with the viewer at another azimuth, by `harmonic_index`.
class TurnedLobe {
 public:
  /// `viewer` is the viewer's direction, of any length, across the normal.
  TurnedLobe(const Lobe& lobe, Vec2 viewer);

  int order() const { return order_; }
  const Rgb* coefficients() const { return coefficients_.data(); }

 private:
  int order_;
  std::array<Rgb, harmonics_count(most_order)> coefficients_;
};

}  // namespace isophote
