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

int bands_for(const GlossyMethod& method, const GlossyLobes& lobes, float alpha) {
  for (int bands = 2; bands <= most_bands; ++bands)
    if (lobes.truncation(alpha, cos_45, bands) < missed_at_45) return bands;
  return method.from == Glossy::cache ? most_bands : 0;
}

}  // namespace

CachedLobe cached_lobe(const GlossyMethod& method, const Bsdf& bsdf, const Vec3& wo) {
  if (!method.caches() || !bsdf.has_glossy() || bsdf.alpha < GlossyLobes::least_alpha) return {};
  const GlossyLobes& lobes = glossy_lobes(method.basis);
  const int bands = bands_for(method, lobes, bsdf.alpha);
  if (bands == 0) return {};
  if (method.from == Glossy::cache) return {bands, 1};
  const float by_view = lobes.truncation(bsdf.alpha, dot(wo, bsdf.frame.n), bands);
  const float by_roughness = lobes.truncation(bsdf.alpha, cos_45, most_bands);
  const float albedo = max_component(specular_albedo(bsdf, dot(wo, bsdf.frame.n)));
  return {bands, falling(by_view, missed_at_viewer, missed_by_far) *
                     falling(by_roughness, missed_at_45 / 2, missed_at_45) * (1 - falling(albedo, faint, bright))};
}

}  // namespace isophote
