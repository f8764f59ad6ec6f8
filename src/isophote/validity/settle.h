#pragma once

#include "isophote/validity/neighbour_index.h"

namespace isophote {

/// How radii follow from unscaled ones, and what neighbours ask of each other.
struct SettleRule {
  float scale = 1;  ///< the metric's radius over the unscaled one
  float slope = 0;  ///< R_i <= R_j + slope |x_i - x_j| on the unscaled radii of records that face alike: 1 for
                    ///< distances [Krivanek 2006]; 0: no such bound
};

/// What records do to each other and to themselves once inserted: neighbour clamping, where asked; and where a lower
/// bound raised a radius above what the metric gives, that reach holds along the surface only, and extrapolation is
/// limited. `fresh` are the ids of the newest records, ascending and without gaps, which the others have not met. Radii
/// only shrink.
template <class R>
void settle(const SettlingOf<R>& settling, std::span<const std::uint32_t> fresh, const SettleRule& rule);

}  // namespace isophote
