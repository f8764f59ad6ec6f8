#include "isophote/derivatives/krivanek_2005a.h"

#include "isophote/derivatives/radiance_gradient_sum.h"
#include "isophote/derivatives/surface_sample.h"
#include "isophote/derivatives/tangent.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {

Jet<Rgb> krivanek_2005a(const HemisphereGather& gather) {
  Jet<Rgb> jet = irradiance(gather);
  TangentGradient gradient;
  for_each_surface_sample(gather, [&](const SurfaceSample& s) {
    const Rgbd light = s.irradiance * s.inverse_distance;
    gradient.u += light * (4 * s.direction.x + s.tilt.x);
    gradient.v += light * (4 * s.direction.y + s.tilt.y);
  });
  jet.translational = gradient.to_world(gather.frame);
  jet.rotational = rotational_gradient(gather, RotationWeights::exact);
  return jet;
}

// A function W of direction weighs a piece of surface by its solid angle cos_y dA / r^2, and this by W; as the record
// moves, W cos_y / r^2 changes by (W (3 w + n_y / cos_y) - grad W) / r times itself. With distance and tilt those of
// the sample, that is integrated over its stratum exactly, where grad W, which for hemispherical harmonics has no bound
// at the horizon, becomes an integral around the stratum: of W nu dl, nu pointing out, plus 2 W w over it.
RadianceJet krivanek_2005a(const HemisphereGather& gather, Basis basis, int order) {
  RadianceJet jet = incident_radiance(gather, basis, order);
  const Strata& s = gather.strata;
  const StrataHarmonics& h = strata_harmonics(basis, order, s);
  std::vector<double> radial(polar_count(order));
  RadianceGradientRows across(h.azimuths()), around(h.azimuths()), tilted(h.azimuths());
  RadianceGradientSum sum(order);
  const Framed frame(gather.frame);
  for (int j = 0; j < s.polar; ++j) {
    across.clear(), around.clear(), tilted.clear();
    for (int k = 0; k < s.azimuthal; ++k) {
      const SurfaceSample piece(gather, gather.at(j, k), frame);
      const Rgbd light = Rgbd(gather.at(j, k).radiance) * piece.inverse_distance;
      if (is_black(light)) continue;
      across.add(light, h.cos_over_cell(k), h.sin_over_cell(k));
      tilted.add(light * piece.tilt.x, light * piece.tilt.y, h.over_cell(k));
      for (const int end : {k, k + 1}) {
        const double out = end == k ? -1 : 1, phi = s.azimuth(end);
        around.add(light * (out * std::sin(phi)), light * (-out * std::cos(phi)), h.between_cells(end % s.azimuthal));
      }
    }
    const double inner = s.sin_edge(j) * s.cos_edge(j), outer = s.sin_edge(j + 1) * s.cos_edge(j + 1);
    for (std::size_t i = 0; i < radial.size(); ++i)
      radial[i] = h.sin_over_ring(j)[i] - outer * h.between_rings(j + 1)[i] + inner * h.between_rings(j)[i];
    sum.add(h, radial, across), sum.add(h, h.along_ring(j), around), sum.add(h, h.over_ring(j), tilted);
  }
  sum.store(jet);
  return jet;
}

}  // namespace isophote
