#include "isophote/integrate/gather_layers.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/in_scattering.h"
#include "isophote/sampling/few_choice.h"
#include "isophote/trace/placed_lights.h"

namespace isophote {
namespace {

/// One shell of a ray, as far as caches know it.
struct Looked {
  MediumPoint point;
  Rgb weight;          ///< sigma_s times transmittance, over the shell: of the light in-scattered there
  Rgb placed;          ///< what is seen of light of points and spots, from places of its own
  LightChange change;  ///< of that, and by directions of all light of directly sampled emitters
  bool wants_path = false;

  /// The logarithmic gradient of a layer as the record moves and places stay, of which it has that at `point`.
  void complete(GatherLayer& layer) const {
    const Rgb here = layer.radiance - placed;
    const auto along = [&](Rgb& log_gradient, const Rgb& passage, const Rgb& turn) {
      for (int c = 0; c < 3; ++c)
        if (layer.radiance[c] > 0)
          log_gradient[c] = (here[c] * log_gradient[c] + passage[c] - turn[c] / layer.depth) / layer.radiance[c];
    };
    along(layer.log_gradient.x, change.passage.x, change.turn.x);
    along(layer.log_gradient.y, change.passage.y, change.turn.y);
    along(layer.log_gradient.z, change.passage.z, change.turn.z);
  }
};

/// What a place scatters of directly sampled emitters' light, but of point and spot lights.
Rgb directly_lit(const World& world, const Vec3& direction, Sampler& sampler, RayCounts& counts, Looked& here) {
  Gradient<Rgb> slope;
  const Rgb light = direct_light(world, here.point, direction, sampler, counts, &slope);
  add(here.change.turn, slope, here.weight);
  return here.weight * light;
}

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
    const Ray shell{ray.origin, ray.direction, l > 0 ? ends[l - 1] : 0, ends[l]};
    Looked& here = looked[l];
    here.placed = placed_lights_along(world, shell, {}, sampler, counts, &here.change);
    layer.radiance = passes * at.emission + here.placed;
    if (is_black(at.scattering)) continue;
    here.point = at.point;
    here.weight = passes * at.scattering;
    layer.radiance += directly_lit(world, ray.direction, sampler, counts, here);
    const auto indirect = cached_in_scattering(world, from, here.point, ray.direction, counts);
    here.wants_path = !indirect;
    if (indirect) layer.radiance += here.weight * *indirect;
  }
  follow_one_path(world, looked, ray.direction, 1, sampler, counts, layers.subspan(1));
  for (int l = 0; l < count; ++l) looked[l].complete(layers[l + 1]);
  sample.radiance = {};
  for (const GatherLayer& layer : layers) sample.radiance += layer.radiance;
}

}  // namespace isophote
