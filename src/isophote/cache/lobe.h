#pragma once

#include <array>

#include "isophote/core/rgb.h"
#include "isophote/harmonics/basis.h"

namespace isophote {

/// A glossy lobe towards one viewer, for incident directions in the surface's frame with the viewer at azimuth 0: bsdf
/// times the cosine, as coefficients of the cache's basis. Being even in azimuth it has those of m >= 0 alone, by
/// `polar_index`. Its product with incident radiance, summed over all, is the radiance reflected.
struct Lobe {
  int order = 0;
  std::array<Rgb, polar_count(most_order)> coefficients;
};

}  // namespace isophote
