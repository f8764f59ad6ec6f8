#include "isophote/derivatives/incident_radiance.h"

#include "isophote/core/check.h"
#include "isophote/harmonics/strata_harmonics.h"

namespace isophote {

RadianceJet incident_radiance(const HemisphereGather& gather, Basis basis, int order) {
  const Strata& s = gather.strata;
  ISOPHOTE_CHECK(gather.samples.size(), ==, static_cast<std::size_t>(s.size()));
  const StrataHarmonics& h = strata_harmonics(basis, order, s);
  std::vector<Rgbd> sums(harmonics_count(order)), by_azimuth(h.azimuths());
  double inverse_distances = 0;
  for (int j = 0; j < s.polar; ++j) {
    by_azimuth.assign(by_azimuth.size(), {});
    for (int k = 0; k < s.azimuthal; ++k) {
      const GatherSample& sample = gather.at(j, k);
      inverse_distances += 1 / static_cast<double>(sample.distance);
      const auto over_cell = h.over_cell(k);
      for (std::size_t m = 0; m < by_azimuth.size(); ++m) by_azimuth[m] += Rgbd(sample.radiance) * over_cell[m];
    }
    h.add<Rgbd>(h.over_ring(j), by_azimuth, sums);
  }
  RadianceJet jet;
  jet.value = Coefficients(sums.begin(), sums.end());
  jet.rays = static_cast<std::uint32_t>(gather.samples.size());
  jet.distances.harmonic_mean = static_cast<float>(s.size() / inverse_distances);
  jet.distances.obstacles = obstacles(gather);
  return jet;
}

}  // namespace isophote
