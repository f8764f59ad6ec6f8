// What so many bands miss of a metal's glossy lobe, and what the rule makes of it. Prints JSON. Driven by bench/run.
#include <fmt/format.h>

#include <cmath>

#include "isophote/cache/catalogue.h"
#include "isophote/integrate/glossy_lobes.h"
#include "isophote/integrate/glossy_rule.h"

namespace isophote {
namespace {

Bsdf metal(float roughness) {
  Bsdf bsdf;
  bsdf.frame = Frame(Vec3{0, 0, 1});
  bsdf.f0 = Rgb(0.8f), bsdf.f90 = 1;
  bsdf.alpha = roughness * roughness;
  return bsdf;
}

void print(float roughness) {
  const GlossyMethod method = find_method("cached").glossy;
  const Bsdf bsdf = metal(roughness);
  fmt::print("\"{:g}\": {{\"bands\": {}", roughness, cached_lobe(method, bsdf, {0, 0, 1}).bands);
  for (const int degrees : {0, 45, 75}) {
    const float angle = static_cast<float>(degrees) * pi / 180, cosine = std::cos(angle);
    const auto missed = glossy_lobes(method.basis).truncation(bsdf.alpha, cosine);
    fmt::print(", \"{}\": {{\"share\": {:.3f}", degrees, cached_lobe(method, bsdf, {std::sin(angle), 0, cosine}).share);
    for (const int bands : {4, 6, 8, 10, 12}) fmt::print(", \"{}\": {:.4f}", bands, missed[bands]);
    fmt::print("}}");
  }
  fmt::print("}}");
}

}  // namespace
}  // namespace isophote

int main() {
  fmt::print("{{");
  bool first = true;
  for (const float roughness : {0.4f, 0.45f, 0.5f, 0.55f, 0.6f, 0.65f, 0.7f, 0.8f, 0.9f, 1.0f}) {
    if (!first) fmt::print(", ");
    first = false;
    isophote::print(roughness);
  }
  fmt::print("}}\n");
}
