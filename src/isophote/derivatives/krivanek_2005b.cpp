#include "isophote/derivatives/krivanek_2005b.h"

#include "isophote/derivatives/radiance_gradient_sum.h"
#include "isophote/derivatives/wall_step.h"

namespace isophote {

RadianceJet krivanek_2005b(const HemisphereGather& gather, Basis basis, int order) {
  RadianceJet jet = incident_radiance(gather, basis, order);
  const Strata& s = gather.strata;
  const StrataHarmonics& h = strata_harmonics(basis, order, s);
  RadianceGradientRows rings(h.azimuths()), cells(h.azimuths());
  RadianceGradientSum sum(order);
  for (int j = 0; j < s.polar; ++j) {
    rings.clear(), cells.clear();
    const double outward = s.sin_edge(j) * s.cos_edge(j);  // of the wall's normal, times its length over d(phi)
    for (int k = 0; k < s.azimuthal; ++k) {
      const GatherSample& here = gather.at(j, k);
      if (j > 0) rings.add(wall_step(gather.at(j - 1, k), here) * outward, h.cos_over_cell(k), h.sin_over_cell(k));
      const Rgbd change = wall_step(gather.at(j, (k + s.azimuthal - 1) % s.azimuthal), here);
      const double phi = s.azimuth(k);
      cells.add(change * -std::sin(phi), change * std::cos(phi), h.between_cells(k));
    }
    sum.add(h, h.between_rings(j), rings), sum.add(h, h.along_ring(j), cells);
  }
  sum.store(jet);
  return jet;
}

}  // namespace isophote
