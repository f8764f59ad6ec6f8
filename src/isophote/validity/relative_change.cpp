#include "isophote/validity/relative_change.h"

#include <algorithm>

#include "isophote/validity/gradient_radius.h"

namespace isophote {

Footprint relative_change(const VolumeJet& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = view.scene_scale;
  if (jet.gradient_sum > 0) unscaled = std::min(unscaled, jet.value_sum / jet.gradient_sum);
  if (bounds.gradient) unscaled = std::min(unscaled, gradient_radius(jet));
  const RadiusRange range(bounds, view, a);
  Footprint footprint = Footprint::ball(range.largest);
  footprint.unscaled = unscaled;
  footprint.smallest = range.smallest, footprint.largest = range.largest;
  footprint.resize(a * unscaled);
  return footprint;
}

}  // namespace isophote
