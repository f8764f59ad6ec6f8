#include "isophote/integrate/gather_layers.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/in_scattering.h"
#include "isophote/sampling/few_choice.h"

namespace isophote {
namespace {

/// One shell of a ray, as far as caches know it.
struct Looked {
  MediumPoint point;
  Rgb weight;           ///< sigma_s times transmittance, over the shell: of the light in-scattered there
  Gradient<Rgb> slope;  ///< of the light in-scattered there, over directions
  bool wants_path = false;

  /// What that adds to the logarithmic gradient of a layer, as the record moves and this place stays.
  void add_slope(GatherLayer& layer) const {
    for (int c = 0; c < 3; ++c) {
      if (!(layer.radiance[c] > 0)) continue;
      const float scale = -weight[c] / (layer.radiance[c] * layer.depth);
      layer.log_gradient.x[c] += slope.x[c] * scale, layer.log_gradient.y[c] += slope.y[c] * scale;
      layer.log_gradient.z[c] += slope.z[c] * scale;
    }
  }
};

/// One path for all shells of a ray that want one, at one of them, chosen by its weight.
void follow_one_path(const World& world, std::span<const Looked> looked, const Vec3& direction, int depth,
                     Sampler& sampler, RayCounts& counts, std::span<GatherLayer> layers) {
  const FewChoice choice(looked.size(),
                         [&](std::uint32_t l) { return looked[l].wants_path ? mean(looked[l].weight) : 0.0f; });
  if (choice.empty()) return;
  const std::uint32_t chosen = choice.sample(sampler.next());
  const Looked& at = looked[chosen];
  const Scattered scattered = scatter(world, at.point, direction, depth, sampler, counts);
  layers[chosen].radiance += at.weight * scattered.indirect / choice.chance(chosen);
}

}  // namespace

Shells::Shells(int count, float first, float last, std::uint64_t key) : ends(count), shares(count) {
  for (int l = 0; l < count; ++l) {
    ends[l] = count == 1 ? last : first * std::pow(last / first, static_cast<float>(l) / static_cast<float>(count - 1));
    // In the first its depth has to stay away from 0, which derivatives divide by.
    shares[l] = l == 0 ? 0.5f : unit_float(static_cast<std::uint32_t>(hash(key, l)));
  }
}

float Shells::depth(int l, float end) const {
  const float from = l == 0 ? 0 : ends[l - 1];
  return from < end ? from + shares[l] * (std::min(ends[l], end) - from) : end;
}

void gather_layers(const World& world, const FarLight& from, const Ray& ray, const Shells& shells, Sampler& sampler,
                   RayCounts& counts, GatherSample& sample, std::span<GatherLayer> layers) {
  const int count = shells.count();
  thread_local std::vector<float> ends, depths;
  thread_local std::vector<Media::Passage> passages;
  thread_local std::vector<Looked> looked;
  ends.clear(), depths.clear(), looked.assign(static_cast<std::size_t>(count), {});
  for (const float end : shells.ends) ends.push_back(std::min(end, sample.distance));
  const auto points = world.media->sample_parts({ray.origin, ray.direction, 0, sample.distance}, ends, sampler);
  for (int l = 0; l < count; ++l)
    depths.push_back(points[l].length > 0 ? points[l].distance : shells.depth(l, sample.distance));
  depths.push_back(sample.distance);
  passages.resize(depths.size());
  world.media->along(ray, depths, passages);

  layers[0] = {sample.radiance * passages.back().transmittance, sample.distance, passages.back().log_gradient};
  for (int l = 0; l < count; ++l) {
    GatherLayer& layer = layers[l + 1];
    const Media::RayPoint& at = points[l];
    layer = {{}, shells.depth(l, sample.distance), passages[l].log_gradient};
    if (!(at.length > 0)) continue;
    const Rgb passes = passages[l].transmittance * at.length;
    layer.radiance = passes * at.emission;
    if (is_black(at.scattering)) continue;
    Looked& here = looked[l];
    here.point = at.point;
    here.weight = passes * at.scattering;
    Rgb source = direct_light(world, here.point, ray.direction, PunctualKinds::all, sampler, counts, &here.slope);
    const auto indirect = cached_in_scattering(world, from, here.point, ray.direction, counts);
    here.wants_path = !indirect;
    if (indirect) source += *indirect;
    layer.radiance += here.weight * source;
  }
  follow_one_path(world, looked, ray.direction, 1, sampler, counts, layers.subspan(1));
  for (int l = 0; l < count; ++l) looked[l].add_slope(layers[l + 1]);
  sample.radiance = {};
  for (const GatherLayer& layer : layers) sample.radiance += layer.radiance;
}

}  // namespace isophote
