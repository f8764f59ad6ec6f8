#include "isophote/integrate/glossy_rule.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/glossy_lobes.h"

namespace isophote {
namespace {

constexpr int most_bands = 10;
constexpr float missed_at_45 = 0.1f;                            // at most
constexpr float missed_at_viewer = 0.2f, missed_by_far = 0.4f;  // all is cached up to the one, nothing from the other
constexpr float faint = 0.1f, bright = 0.25f;  // albedos: nothing is cached up to the one, all from the other
const float cos_45 = std::sqrt(0.5f);

float falling(float x, float from, float to) { return std::clamp((to - x) / (to - from), 0.0f, 1.0f); }

int bands_for(const GlossyMethod& method, const GlossyLobes::Truncation& at_45) {
  for (int bands = 2; bands <= most_bands; ++bands)
    if (at_45[bands] < missed_at_45) return bands;
  return method.from == Glossy::cache ? most_bands : 0;
}

}  // namespace

CachedLobe cached_lobe(const GlossyMethod& method, const Bsdf& bsdf, const Vec3& wo) {
  if (!method.caches() || !bsdf.has_glossy() || bsdf.alpha < GlossyLobes::least_alpha) return {};
  const GlossyLobes& lobes = glossy_lobes(method.basis);
  const auto at_45 = lobes.truncation(bsdf.alpha, cos_45);
  const int bands = bands_for(method, at_45);
  if (bands == 0) return {};
  if (method.from == Glossy::cache) return {bands, 1};
  const float cos_o = dot(wo, bsdf.frame.n);
  const float by_roughness = falling(at_45[most_bands], missed_at_45 / 2, missed_at_45);
  const float by_view = falling(lobes.truncation(bsdf.alpha, cos_o)[bands], missed_at_viewer, missed_by_far);
  return {bands, by_roughness * by_view * (1 - falling(max_component(specular_albedo(bsdf, cos_o)), faint, bright))};
}

}  // namespace isophote
