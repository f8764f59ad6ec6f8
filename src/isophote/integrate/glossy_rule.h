#pragma once

#include "isophote/cache/catalogue.h"
#include "isophote/scene/bsdf.h"

namespace isophote {

// The one rule by which a glossy lobe's indirect light comes from records of incident radiance or from a ray. It is
// measured in what a lobe's first bands miss of it (GlossyLobes::truncation): seen at 45 degrees that decides how many
// bands there are, seen from where the viewer is, which may be along the surface, whether they will do.

/// How many bands the records have of which a lobe of this roughness is read; 0: none are, rays are followed.
int glossy_bands(const GlossyMethod& method, const Bsdf& bsdf);

/// The share, from 0 to 1, of what a viewer at `wo` is shown that records say; the rest a ray has to find. It goes from
/// the one to the other gradually, so that nothing on a surface shows where.
float cached_share(const GlossyMethod& method, const Bsdf& bsdf, const Vec3& wo);

}  // namespace isophote
