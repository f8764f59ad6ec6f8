#include "isophote/integrate/in_scattering.h"

#include "isophote/cache/volume_cache.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/meet.h"
#include "isophote/scene/phase.h"

namespace isophote {
namespace {

/// What records are asked at a point that scatters light back along a ray.
struct Asked {
  VolumeQuery query;
  int bands;
  PhaseLobe lobe;
  LeakTest open;

  Asked(const World& world, const MediumPoint& point, const Vec3& direction, RayCounts& counts)
      : query{point.position, world.media->holding(point.position)},
        bands(bands_for(point.g)),
        lobe(phase_lobe(point.g, -direction, bands)),
        open{world, counts} {}

  std::optional<Rgb> of(const VolumeCache& cache) const {
    return cache.scattered(query, {lobe.data(), static_cast<std::size_t>(harmonics_count(bands))}, bands, open);
  }
};

bool knows_media(const FarLight& from) { return from.records && from.records->volumes(); }

/// Light of surfaces and the sky that a point scatters back along a ray, by a ray that the phase function chooses.
Rgb scattered_of_surfaces(const World& world, const FarLight& from, const MediumPoint& point, const Vec3& direction,
                          int depth, Sampler& sampler, RayCounts& counts) {
  const Ray ray{point.position, sample_henyey_greenstein(point.g, direction, sampler.next2())};
  const GatherSample met = meet(world, from, ray, point.inside, depth, sampler, counts);
  return met.radiance * world.media->transmittance({ray.origin, ray.direction, 0, met.distance}, sampler.next_bits());
}

}  // namespace

std::optional<Rgb> cached_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                        const Vec3& direction, RayCounts& counts) {
  if (!knows_media(from)) return std::nullopt;
  const VolumeCaches& caches = *from.records->volumes();
  const Asked asked(world, point, direction, counts);
  const auto surfaces = asked.of(caches.surfaces);
  if (!surfaces) return std::nullopt;
  const auto media = asked.of(caches.media);
  if (!media) return std::nullopt;
  return *surfaces + *media;
}

std::optional<Rgb> seen_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                      const Vec3& direction, int depth, Sampler& sampler, RayCounts& counts) {
  if (bands_hold(point.g) || !knows_media(from)) return cached_in_scattering(world, from, point, direction, counts);
  auto light = Asked(world, point, direction, counts).of(from.records->volumes()->media);
  if (light) *light += scattered_of_surfaces(world, from, point, direction, depth + 1, sampler, counts);
  return light;
}

}  // namespace isophote
