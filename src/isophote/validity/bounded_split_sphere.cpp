#include "isophote/validity/bounded_split_sphere.h"

#include <algorithm>

#include "isophote/validity/gradient_radius.h"
#include "isophote/validity/split_sphere.h"

namespace isophote {

template <class V>
Footprint bounded_split_sphere(const Jet<V>& jet, const View& view, float a, const RadiusBounds& bounds) {
  float unscaled = std::min(jet.distances.harmonic_mean, view.scene_scale);
  if (bounds.gradient) unscaled = std::min(unscaled, gradient_radius(jet));
  const RadiusRange range(bounds, view, a);
  Footprint footprint = Footprint::disk(range.largest, 1 / a);
  footprint.unscaled = unscaled;
  footprint.smallest = range.smallest;
  footprint.largest = range.largest;
  footprint.resize(split_sphere_radius(unscaled, a));
  footprint.falloff = Falloff::tent;
  return footprint;
}

template Footprint bounded_split_sphere(const Jet<Rgb>&, const View&, float, const RadiusBounds&);
template Footprint bounded_split_sphere(const RadianceJet&, const View&, float, const RadiusBounds&);

}  // namespace isophote
