#include "isophote/validity/relative_change.h"

#include <algorithm>

#include "isophote/validity/gradient_radius.h"

namespace isophote {

Footprint relative_change(const VolumeJet& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = view.scene_scale;
  if (jet.gradient_sum > 0) unscaled = std::min(unscaled, jet.value_sum / jet.gradient_sum);
  const float of_gradient = gradient_radius(jet);
  if (bounds.gradient) unscaled = std::min(unscaled, of_gradient);
  RadiusRange range(bounds, view, a);
  if (a > 1) range.largest = std::clamp(of_gradient, range.smallest, range.largest);
  Footprint footprint = Footprint::ball(range.largest);
  footprint.unscaled = unscaled;
  footprint.smallest = range.smallest, footprint.largest = range.largest;
  footprint.resize(a * unscaled);
  return footprint;
}

}  // namespace isophote
