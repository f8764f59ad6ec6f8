#pragma once

#include "isophote/core/frame.h"
#include "isophote/core/rgb.h"
#include "isophote/core/vec.h"

namespace isophote {

/// How light scatters at one point: a diffuse lobe, a glossy lobe, and specular (delta) lobes. All directions point
/// away from the surface, in world space; `frame.n` is the mapped normal on the side of the viewer. Every `evaluate`
/// and `weight` includes the cosine at the incident direction; densities are in solid angle.
///
/// The diffuse lobe is diffuse/pi * (1 - specular albedo at the outgoing angle, largest channel): it does not depend on
/// the incident direction, so that it can be cached exactly. Reciprocity holds per lobe only.
struct Bsdf {
  Frame frame;
  Rgb diffuse;         ///< base (1 - metallic) (1 - transmission)
  Rgb f0;              ///< reflectance at normal incidence
  float f90 = 1;       ///< and at grazing
  float alpha = 1;     ///< GGX roughness; below `smooth_alpha` the glossy lobe is a mirror
  Rgb transmission;    ///< tint times transmission weight of smooth glass, 0 for opaque
  float eta = 1.5f;    ///< index of the far side over that of the viewer's side
  bool solid = false;  ///< refracts; otherwise a thin sheet: light goes straight through

  static constexpr float smooth_alpha = 1e-3f;
  bool is_mirror() const { return alpha < smooth_alpha; }
  bool has_diffuse() const { return max_component(diffuse) > 0; }
  bool has_glossy() const { return !is_mirror() && (max_component(f0) > 0 || f90 > 0); }
  bool has_specular() const {
    return (is_mirror() && (max_component(f0) > 0 || f90 > 0)) || max_component(transmission) > 0;
  }
};

/// Directional albedo of the glossy or mirror lobe, seen from cos_o.
Rgb specular_albedo(const Bsdf& bsdf, float cos_o);

/// Albedo of the diffuse lobe towards `wo`: reflected radiance = diffuse_albedo / pi * irradiance.
Rgb diffuse_albedo(const Bsdf& bsdf, const Vec3& wo);

/// The glossy lobe: GGX with visible-normal sampling [Heitz 2018].
Rgb evaluate_glossy(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi);
float glossy_pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi);

struct BsdfSample {
  Vec3 direction;
  Rgb weight;     ///< f cos / pdf
  float pdf = 0;  ///< 0 for a delta lobe
  bool transmitted = false;
};
/// A direction of the glossy lobe; weight is black where it falls under the surface.
BsdfSample sample_glossy(const Bsdf& bsdf, const Vec3& wo, Vec2 u);

/// The chances with which one lobe is chosen at `wo`; they sum to 1, or are all 0 on a black surface.
struct LobeChances {
  float diffuse = 0, glossy = 0, specular = 0;
};
LobeChances lobe_chances(const Bsdf& bsdf, const Vec3& wo);

/// One of the delta lobes (mirror reflection, Fresnel reflection and refraction of glass), chosen by `u`; the weight
/// holds the chance of this choice but not that of having chosen the specular lobes. Refraction into a solid scales
/// radiance by 1/eta^2, which leaving it undoes.
BsdfSample sample_specular(const Bsdf& bsdf, const Vec3& wo, float u);

/// The share of light that passes a thin sheet straight through, from `wo` or towards it: what the sampled transmission
/// is on average. Black for all else.
Rgb sheet_transmittance(const Bsdf& bsdf, const Vec3& wo);

}  // namespace isophote
