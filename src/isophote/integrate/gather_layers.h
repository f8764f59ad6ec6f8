#pragma once

#include <span>
#include <vector>

#include "isophote/derivatives/gather.h"
#include "isophote/integrate/far_light.h"

namespace isophote {

/// How the rays of one gather are cut by depth. Shells get thicker with depth, each by the same factor but the first,
/// which begins at 0. Each has its depth by the same share of the shell for all rays: derivatives divide by depth, and
/// only where that is common to all directions does what it does cancel.
struct Shells {
  std::vector<float> ends;    ///< depths, ascending
  std::vector<float> shares;  ///< in [0, 1)

  /// From `first` > 0 to `last`.
  Shells(int count, float first, float last, std::uint64_t key);

  int count() const { return static_cast<int>(ends.size()); }
  /// That of shell l along a ray that ends at `end`, which it is too where the shell begins beyond.
  float depth(int l, float end) const;
};

/// Has the media of the world, which must have some, act on what `sample` saw, whose radiance is without them, and adds
/// the light that they scatter on the way there: `from` what is known of it, or from a path. A shell is looked at in
/// one place, chosen by what is seen of it. Fills shells.count() + 1 layers, of which the sample's radiance becomes the
/// sum.
void gather_layers(const World& world, const FarLight& from, const Ray& ray, const Shells& shells, Sampler& sampler,
                   RayCounts& counts, GatherSample& sample, std::span<GatherLayer> layers);

}  // namespace isophote
