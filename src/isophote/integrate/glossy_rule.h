#pragma once

#include "isophote/cache/catalogue.h"
#include "isophote/scene/bsdf.h"

namespace isophote {

// The one rule by which a glossy lobe's indirect light comes from records of incident radiance or from a ray. It is
// measured in what a lobe's first bands miss of it (GlossyLobes::truncation): seen at 45 degrees that decides how many
// bands there are, seen from where the viewer is, which may be along the surface, whether they will do. And a lobe that
// reflects little, as a coat of varnish seen from above, is not worth records: few rays say as much of it.

struct CachedLobe {
  int bands = 0;    ///< of the records of which a lobe of this roughness is read; 0: none are, rays are followed
  float share = 0;  ///< from 0 to 1, of what the viewer is shown, that records say; the rest a ray has to find
};

/// For a viewer at `wo`. The share goes from 1 to 0 gradually, so that nothing on a surface shows where.
CachedLobe cached_lobe(const GlossyMethod& method, const Bsdf& bsdf, const Vec3& wo);

}  // namespace isophote
