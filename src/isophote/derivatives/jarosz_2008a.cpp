#include "isophote/derivatives/jarosz_2008a.h"

namespace isophote {

VolumeJet jarosz_2008a(const SphereGather& gather, VolumePart part, int order) {
  VolumeJet jet = unweighed_jet(gather, part);
  store(jet, weigh_fixed_places(gather, part, HarmonicWeights{order}));
  return jet;
}

}  // namespace isophote
