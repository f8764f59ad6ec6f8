#include "isophote/integrate/gather.h"

#include <algorithm>
#include <numeric>

#include "isophote/integrate/gather_layers.h"
#include "isophote/integrate/meet.h"

namespace isophote {
namespace {

/// Shells about a place, to the end of all media: the first is thin, beside the scene and beside the free path.
Shells shells_at(const World& world, const Vec3& position, std::uint64_t key) {
  constexpr int count = 12;
  constexpr float of_scene = 0.01f, of_free_path = 0.25f;
  const float scale = world.rays.scene_scale(), extinction = max_component(world.media->extinction(position));
  const Box media = world.media->bounds();
  const float farthest = length(max(media.upper - position, position - media.lower));
  return {count, 1 / std::max(1 / (of_scene * scale), extinction / of_free_path), std::max(scale, farthest), key};
}

/// What media do along the ray of the i-th sample; what they scatter at the record itself, by the first shell.
template <class Gather>
void add_layers(const World& world, const FarLight& from, const Ray& ray, const Shells& shells, int i, Sampler& sampler,
                RayCounts& counts, Gather& gather) {
  const auto size = static_cast<std::size_t>(shells.count() + 1), index = static_cast<std::size_t>(i);
  const auto layers = std::span(gather.layers).subspan(index * size, size);
  gather_layers(world, from, ray, shells, sampler, counts, gather.samples[index], layers);
  if (!gather.sources.empty())
    gather.sources[index] = layers[1].radiance / std::min(shells.ends[0], gather.samples[index].distance);
}

/// A step that visits all of `size` strata, early ones well spread over the hemisphere: the first rays into a cell
/// leave samples that later ones read, and must not all come from one side of it.
int well_spread_step(int size) {
  int step = std::max(1, static_cast<int>(0.618 * size));
  while (std::gcd(step, size) != 1) ++step;
  return step;
}

}  // namespace

void gather_hemisphere(const World& world, const FarLight& from, const Place& place, Strata strata, std::uint64_t key,
                       HemisphereGather& gather, RayCounts& counts) {
  gather.position = place.position;
  gather.frame = Frame(place.normal);
  gather.strata = strata;
  gather.samples.resize(static_cast<std::size_t>(strata.size()));
  SurfacePoint surface;
  surface.position = place.position;
  surface.geometric_normal = place.geometric_normal;
  surface.offset = place.offset;
  std::optional<Shells> shells;
  if (world.media) shells = shells_at(world, place.position, key);
  gather.shells = shells ? shells->count() : 0;
  gather.layers.assign(shells ? gather.samples.size() * static_cast<std::size_t>(shells->count() + 1) : 0, {});
  const bool alike = !shells || !(world.media->anisotropy(~0u) > 0);
  gather.sources.assign(alike ? 0 : gather.samples.size(), {});
  const int step = well_spread_step(strata.size());
  for (int n = 0, i = 0; n < strata.size(); ++n, i = (i + step) % strata.size()) {
    Sampler sampler(key, static_cast<std::uint32_t>(i));
    const Vec3 direction =
        gather.frame.to_world(strata.direction(i / strata.azimuthal, i % strata.azimuthal, sampler.next2()));
    // A direction over the interpolated horizon but under the surface itself sees nothing.
    if (dot(direction, place.geometric_normal) <= 0) {
      gather.samples[i] = {direction, infinity, Rgb{}, -direction, GatherSample::own_surface};
      continue;
    }
    const Ray ray{offset_origin(surface, direction), direction};
    gather.samples[i] = meet(world, from, ray, place.medium, 1, sampler, counts);
    if (shells) add_layers(world, from, ray, *shells, i, sampler, counts, gather);
  }
}

void gather_sphere(const World& world, const FarLight& from, const Vec3& position, const Rgb& inside,
                   SphereStrata strata, std::uint64_t key, SphereGather& gather, RayCounts& counts) {
  gather.position = position;
  gather.strata = strata;
  gather.samples.resize(static_cast<std::size_t>(strata.size()));
  gather.sources.resize(gather.samples.size());
  const Shells shells = shells_at(world, position, key);
  gather.shells = shells.count(), gather.shell_ends = shells.ends;
  gather.layers.assign(gather.samples.size() * static_cast<std::size_t>(shells.count() + 1), {});
  const int step = well_spread_step(strata.size());
  for (int n = 0, i = 0; n < strata.size(); ++n, i = (i + step) % strata.size()) {
    Sampler sampler(key, static_cast<std::uint32_t>(i));
    const Ray ray{position, strata.direction(i / strata.azimuthal, i % strata.azimuthal, sampler.next2())};
    gather.samples[i] = meet(world, from, ray, inside, 1, sampler, counts);
    add_layers(world, from, ray, shells, i, sampler, counts, gather);
  }
}

}  // namespace isophote
