#include "isophote/integrate/in_scattering.h"

#include "isophote/cache/volume_cache.h"
#include "isophote/integrate/leak_test.h"

namespace isophote {

std::optional<Rgb> cached_in_scattering(const World& world, const FarLight& from, const MediumPoint& point,
                                        const Vec3& direction, RayCounts& counts) {
  if (!from.records || !from.records->volumes()) return std::nullopt;
  const VolumeCaches& caches = *from.records->volumes();
  const VolumeQuery query{point.position, world.media->holding(point.position)};
  const int bands = bands_for(point.g);
  const PhaseLobe lobe = phase_lobe(point.g, -direction, bands);
  const std::span<const float> used(lobe.data(), static_cast<std::size_t>(harmonics_count(bands)));
  const LeakTest open{world, counts};
  const auto surfaces = caches.surfaces.scattered(query, used, bands, open);
  if (!surfaces) return std::nullopt;
  const auto media = caches.media.scattered(query, used, bands, open);
  if (!media) return std::nullopt;
  return *surfaces + *media;
}

}  // namespace isophote
