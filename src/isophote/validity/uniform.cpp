#include "isophote/validity/uniform.h"

namespace isophote {

Footprint uniform(const View& view, float a) {
  Footprint footprint = Footprint::disk(0.1f * a * view.scene_scale, 1 / a);
  footprint.unscaled = footprint.radius;
  footprint.falloff = Falloff::tent;
  return footprint;
}

Footprint uniform_in_media(const View& view, float a) { return Footprint::ball(0.1f * a * view.scene_scale); }

}  // namespace isophote
