#include "isophote/scene/bsdf.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/ray.h"
#include "isophote/sampling/warp.h"
#include "isophote/scene/ggx.h"

namespace isophote {
namespace {

float fifth_power(float x) {
  const float squared = x * x;
  return squared * squared * x;
}

Rgb schlick(const Bsdf& bsdf, float cos_theta) {
  const float grazing = fifth_power(std::clamp(1 - cos_theta, 0.0f, 1.0f));
  return bsdf.f0 * (1 - grazing) + Rgb(bsdf.f90 * grazing);
}

/// Fresnel reflectance of a smooth dielectric; 1 under total internal reflection.
float dielectric_reflectance(float cos_i, float cos_t, float eta) {
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// The cosine on the far side, negative under total internal reflection.
float refracted_cosine(float cos_i, float eta) {
  const float squared = 1 - (1 - cos_i * cos_i) / (eta * eta);
  return squared > 0 ? std::sqrt(squared) : -1.0f;
}

/// Reflectance of glass: the exact curve, stretched between f0 and f90 so that KHR_materials_specular acts on it.
Rgb glass_reflectance(const Bsdf& bsdf, float cos_i) {
  const float cos_t = refracted_cosine(cos_i, bsdf.eta);
  if (cos_t < 0) return Rgb(1.0f);
  const float normal = (bsdf.eta - 1) / (bsdf.eta + 1), at_normal = normal * normal;
  const float grazing = (dielectric_reflectance(cos_i, cos_t, bsdf.eta) - at_normal) / (1 - at_normal);
  // Of indices above 3.7 the curve falls before it rises: a tinted one would fall below 0.
  return max(bsdf.f0 * (1 - grazing) + Rgb(bsdf.f90 * grazing), Rgb(0.0f));
}

bool has_reflection(const Bsdf& bsdf) { return max_component(bsdf.f0) > 0 || bsdf.f90 > 0; }
bool is_glass(const Bsdf& bsdf) { return max_component(bsdf.transmission) > 0; }

/// The share that is let through where `albedo` is reflected.
Rgb transmitted(const Bsdf& bsdf, const Rgb& albedo) { return bsdf.transmission * (1 - max_component(albedo)); }

}  // namespace

Rgb specular_albedo(const Bsdf& bsdf, float cos_o) {
  if (is_glass(bsdf) && bsdf.is_mirror()) return glass_reflectance(bsdf, cos_o);
  if (!has_reflection(bsdf)) return Rgb(0.0f);
  if (bsdf.is_mirror()) return schlick(bsdf, cos_o);
  const ggx::SplitSum split = ggx::split_sum(cos_o, bsdf.alpha);
  return bsdf.f0 * split.f0 + Rgb(bsdf.f90 * split.f90);
}

Rgb diffuse_albedo(const Bsdf& bsdf, const Vec3& wo) {
  if (!bsdf.has_diffuse()) return Rgb(0.0f);
  return bsdf.diffuse * (1 - max_component(specular_albedo(bsdf, dot(wo, bsdf.frame.n))));
}

Rgb evaluate_glossy(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  const Vec3 o = bsdf.frame.to_local(wo), i = bsdf.frame.to_local(wi);
  if (!(o.z > 0 && i.z > 0)) return Rgb(0.0f);
  const Vec3 h = normalize(o + i);
  const float d = ggx::distribution(h, bsdf.alpha), g2 = ggx::masking_shadowing(o, i, bsdf.alpha);
  return schlick(bsdf, dot(o, h)) * (d * g2 / (4 * o.z));
}

float glossy_pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  const Vec3 o = bsdf.frame.to_local(wo), i = bsdf.frame.to_local(wi);
  if (!(o.z > 0 && i.z > 0)) return 0;
  return ggx::distribution(normalize(o + i), bsdf.alpha) * ggx::masking(o, bsdf.alpha) / (4 * o.z);
}

BsdfSample sample_glossy(const Bsdf& bsdf, const Vec3& wo, Vec2 u) {
  const Vec3 o = bsdf.frame.to_local(wo);
  if (!(o.z > 0)) return {};
  const Vec3 h = ggx::sample_visible_normal(o, bsdf.alpha, u);
  const Vec3 i = h * (2 * dot(o, h)) - o;
  if (!(i.z > 0)) return {};
  const float g1 = ggx::masking(o, bsdf.alpha), g2 = ggx::masking_shadowing(o, i, bsdf.alpha);
  return {bsdf.frame.to_world(i), schlick(bsdf, dot(o, h)) * (g2 / g1),
          ggx::distribution(h, bsdf.alpha) * g1 / (4 * o.z), false};
}

LobeChances lobe_chances(const Bsdf& bsdf, const Vec3& wo) {
  const Rgb reflected = specular_albedo(bsdf, dot(wo, bsdf.frame.n));
  const float left = 1 - max_component(reflected);
  LobeChances chances;
  chances.diffuse = left * mean(bsdf.diffuse);
  chances.specular = left * mean(bsdf.transmission);
  (bsdf.is_mirror() ? chances.specular : chances.glossy) += mean(reflected);
  const float sum = chances.diffuse + chances.glossy + chances.specular;
  if (!(sum > 0)) return {};
  return {chances.diffuse / sum, chances.glossy / sum, chances.specular / sum};
}

Rgb sheet_transmittance(const Bsdf& bsdf, const Vec3& wo) {
  if (bsdf.solid || !is_glass(bsdf)) return Rgb(0.0f);
  return transmitted(bsdf, specular_albedo(bsdf, std::min(1.0f, dot(wo, bsdf.frame.n))));
}

BsdfSample sample_specular(const Bsdf& bsdf, const Vec3& wo, float u) {
  const Vec3& n = bsdf.frame.n;
  const float cos_o = std::min(1.0f, dot(wo, n));
  const Rgb albedo = specular_albedo(bsdf, cos_o);
  const Rgb reflected = bsdf.is_mirror() ? albedo : Rgb(0.0f);  // otherwise the glossy lobe's
  const Rgb passed = transmitted(bsdf, albedo);
  const float sum = mean(reflected) + mean(passed);
  if (!(sum > 0)) return {};
  const float chance = mean(reflected) / sum;
  if (u < chance) return {n * (2 * cos_o) - wo, reflected / chance, 0, false};
  const Rgb weight = passed / (1 - chance);
  if (!bsdf.solid) return {-wo, weight, 0, true};
  const float cos_t = refracted_cosine(cos_o, bsdf.eta);
  if (cos_t < 0) return {};
  const Vec3 direction = (n * cos_o - wo) / bsdf.eta - n * cos_t;
  // Radiance is denser by the square of the index where light travels slower.
  return {normalize(direction), weight / (bsdf.eta * bsdf.eta), 0, true};
}

}  // namespace isophote
