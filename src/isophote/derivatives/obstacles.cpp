#include "isophote/derivatives/obstacles.h"

#include "isophote/derivatives/sphere_gather.h"

namespace isophote {
namespace {

/// Azimuths are the gather's own; sectors those of the frame that `before` makes of the normal alone.
int sector_at(const HemisphereGather& gather, double k) {
  const double phi = gather.strata.azimuth(k);
  const Vec3 along =
      gather.frame.u * static_cast<float>(std::cos(phi)) + gather.frame.v * static_cast<float>(std::sin(phi));
  const Frame frame(gather.frame.n);
  return Obstacles::sector(dot(along, frame.u), dot(along, frame.v));
}

/// Along the tangent plane for what is low, and the height for what hangs over the record: a query that it hides, on
/// the next board of a shelf, is no nearer than that either.
float reach(const GatherSample& sample, const Vec3& normal) {
  if (!(sample.distance < infinity)) return infinity;
  const float cosine = std::clamp(dot(sample.direction, normal), 0.0f, 1.0f);
  return sample.distance * std::max(cosine, std::sqrt(1 - cosine * cosine));
}

}  // namespace

Obstacles obstacles(const HemisphereGather& gather) {
  const Strata& s = gather.strata;
  Obstacles result;
  for (int k = 0; k < s.azimuthal; ++k) {
    float nearest = infinity;
    for (int j = 0; j < s.polar; ++j) nearest = std::min(nearest, reach(gather.at(j, k), gather.frame.n));
    constexpr int all = Obstacles::sectors;
    const int first = sector_at(gather, k - 1);
    const int more =
        s.azimuthal > 3 ? (sector_at(gather, k + 2) - first + all) % all : all - 1;  // of 3, all are neighbours
    for (int i = 0; i <= more; ++i) result.meet((first + i) % all, nearest);
  }
  return result;
}

ObstaclesAround obstacles(const SphereGather& gather) {
  const SphereStrata& s = gather.strata;
  ObstaclesAround result;
  for (int j = 0; j < s.polar; ++j)
    for (int k = 0; k < s.azimuthal; ++k)
      for (int beside_j = std::max(j - 1, 0); beside_j <= std::min(j + 1, s.polar - 1); ++beside_j)
        for (int beside_k = k - 1; beside_k <= k + 1; ++beside_k)
          result.meet(ObstaclesAround::sector(s.direction(beside_j, beside_k, {0.5f, 0.5f})), gather.at(j, k).distance);
  return result;
}

}  // namespace isophote
