#include "isophote/scene/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "isophote/core/ray.h"
#include "isophote/scene/ggx.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

Vec3 at_angle(float theta) { return {std::sin(theta), 0, std::cos(theta)}; }

Bsdf glossy(float alpha, const Rgb& f0 = Rgb(0.6f)) {
  Bsdf bsdf;
  bsdf.f0 = f0;
  bsdf.alpha = alpha;
  return bsdf;
}
Bsdf smooth_glass(float eta) {
  Bsdf bsdf;
  const float r = (eta - 1) / (eta + 1);
  bsdf.f0 = Rgb(r * r);
  bsdf.alpha = 0;
  bsdf.transmission = Rgb(1.0f);
  bsdf.eta = eta;
  bsdf.solid = true;
  return bsdf;
}

struct LobeCase {
  float alpha, theta;
};
class GlossyLobe : public testing::TestWithParam<LobeCase> {
 protected:
  const Bsdf bsdf = glossy(GetParam().alpha);
  const Vec3 wo = at_angle(GetParam().theta);
};

TEST_P(GlossyLobe, SamplesFollowThePdf) {
  statistics::expect_density(
      [&](Random& r) -> std::optional<Vec3> {
        const BsdfSample s = sample_glossy(bsdf, wo, r.next2());
        if (is_black(s.weight)) return std::nullopt;
        return s.direction;
      },
      [&](const Vec3& wi) { return glossy_pdf(bsdf, wo, wi); });
}

TEST_P(GlossyLobe, WeightIsTheLobeOverThePdf) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const BsdfSample s = sample_glossy(bsdf, wo, random.next2());
    if (is_black(s.weight) || s.direction.z < 1e-3f) continue;
    EXPECT_NEAR(s.pdf / glossy_pdf(bsdf, wo, s.direction), 1, 2e-3);
    EXPECT_NEAR(s.weight.g, evaluate_glossy(bsdf, wo, s.direction).g / s.pdf, 2e-3 * s.weight.g);
  }
}

TEST_P(GlossyLobe, AlbedoIsTheLobesIntegral) {
  // By a midpoint rule over the hemisphere, which does not use the sampling.
  constexpr int n = 1500, m = 1000;
  double integral = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const float z = (i + 0.5f) / n, phi = pi * (j + 0.5f) / m, r = std::sqrt(1 - z * z);  // mirrored in y
      integral += evaluate_glossy(bsdf, wo, {r * std::cos(phi), r * std::sin(phi), z}).g;
    }
  integral *= 2 * M_PI / (double(n) * m);
  EXPECT_NEAR(specular_albedo(bsdf, wo.z).g, integral, 2e-3);
}

TEST_P(GlossyLobe, IsReciprocal) {
  const Vec3 wi = normalize(Vec3{-0.3f, 0.5f, 0.7f});
  EXPECT_NEAR(evaluate_glossy(bsdf, wo, wi).g / wi.z, evaluate_glossy(bsdf, wi, wo).g / wo.z,
              1e-5 * evaluate_glossy(bsdf, wo, wi).g / wi.z);
}

INSTANTIATE_TEST_SUITE_P(Lobes, GlossyLobe,
                         testing::Values(LobeCase{0.1f, 0.3f}, LobeCase{0.25f, 1.0f}, LobeCase{0.5f, 0.0f},
                                         LobeCase{0.5f, 1.35f}, LobeCase{1.0f, 0.8f}));

TEST(Ggx, TableIsAccurate) {
  // Against the visible-normal average with 160,000 points.
  for (const double roughness : {0.04, 0.1, 0.22, 0.3, 0.55, 0.97})
    for (const double c : {0.03, 0.1, 0.35, 0.8, 1.0}) {
      constexpr int n = 400;
      const double alpha = roughness * roughness;
      const Vec3d o{std::sqrt(1 - c * c), 0, c};
      double f0 = 0, f90 = 0;
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          const Vec3d h = ggx::sample_visible_normal(o, alpha, (j + 0.5) / n, (k + 0.5) / n);
          const Vec3d i = h * (2 * dot(o, h)) - o;
          if (i.z <= 0) continue;
          const double g = ggx::masking_shadowing(o, i, alpha) / ggx::masking(o, alpha), s = std::pow(1 - dot(o, h), 5);
          f0 += g * (1 - s) / (n * n), f90 += g * s / (n * n);
        }
      const ggx::SplitSum table = ggx::split_sum(static_cast<float>(c), static_cast<float>(alpha));
      const double tolerance = c < 0.1 ? 3e-3 : 1.5e-3;
      EXPECT_NEAR(table.f0, f0, tolerance) << roughness << " " << c;
      EXPECT_NEAR(table.f90, f90, tolerance) << roughness << " " << c;
    }
}

TEST(Bsdf, WithoutSpecularIsPureLambert) {
  Bsdf bsdf;
  bsdf.diffuse = {0.2f, 0.5f, 0.8f};
  bsdf.f90 = 0;
  EXPECT_EQ(diffuse_albedo(bsdf, at_angle(1.2f)), bsdf.diffuse);
  const LobeChances chances = lobe_chances(bsdf, at_angle(1.2f));
  EXPECT_EQ(chances.diffuse, 1);
  EXPECT_FALSE(bsdf.has_glossy());
  EXPECT_FALSE(bsdf.has_specular());
}

TEST(Bsdf, NeverReflectsMoreThanArrives) {
  Bsdf bsdf = glossy(0.3f, {0.9f, 0.04f, 0.3f});
  bsdf.diffuse = Rgb(1.0f);
  for (const float theta : {0.0f, 0.5f, 1.0f, 1.4f, 1.56f}) {
    const Rgb total = diffuse_albedo(bsdf, at_angle(theta)) + specular_albedo(bsdf, std::cos(theta));
    EXPECT_LE(max_component(total), 1.0001f);
  }
}

TEST(Bsdf, ChancesSumToOneOrAreZero) {
  Bsdf bsdf = smooth_glass(1.5f);
  bsdf.diffuse = Rgb(0.3f);
  const LobeChances c = lobe_chances(bsdf, at_angle(0.4f));
  EXPECT_NEAR(c.diffuse + c.glossy + c.specular, 1, 1e-6);
  Bsdf black;
  black.f90 = 0;
  const LobeChances none = lobe_chances(black, at_angle(0.4f));
  EXPECT_EQ(none.diffuse + none.glossy + none.specular, 0);
}

TEST(Bsdf, MirrorReflects) {
  const Bsdf bsdf = glossy(0, {0.9f, 0.5f, 0.1f});
  const Vec3 wo = at_angle(0.7f);
  const BsdfSample s = sample_specular(bsdf, wo, 0.99f);
  EXPECT_LT(length(s.direction - Vec3{-wo.x, -wo.y, wo.z}), 1e-6f);
  const float schlick = std::pow(1 - wo.z, 5.0f);
  EXPECT_NEAR(s.weight.b, 0.1f + 0.9f * schlick, 1e-6);
  EXPECT_FALSE(s.transmitted);
}

TEST(Glass, RefractsBySnell) {
  for (const float eta : {1.5f, 1 / 1.5f, 2.4f}) {
    const float theta = 0.5f;
    const BsdfSample s = sample_specular(smooth_glass(eta), at_angle(theta), 0.999f);
    ASSERT_TRUE(s.transmitted);
    EXPECT_LT(s.direction.z, 0);
    EXPECT_NEAR(-s.direction.x * eta, std::sin(theta), 1e-5);
    EXPECT_NEAR(length(s.direction), 1, 1e-6);
  }
}

TEST(Glass, ConservesEnergyAndFollowsFresnel) {
  for (const float theta : {0.0f, 0.6f, 1.0f, 1.4f}) {
    const Bsdf bsdf = smooth_glass(1.5f);
    const double cos_i = std::cos(theta), cos_t = std::sqrt(1 - std::pow(std::sin(theta) / 1.5, 2));
    const double rs = (cos_i - 1.5 * cos_t) / (cos_i + 1.5 * cos_t), rp = (1.5 * cos_i - cos_t) / (1.5 * cos_i + cos_t);
    const double expected = 0.5 * (rs * rs + rp * rp);
    EXPECT_NEAR(specular_albedo(bsdf, static_cast<float>(cos_i)).g, expected, 1e-5);
    // Whichever is chosen, nothing is lost: refracted radiance is the incident one over eta^2.
    const BsdfSample refracted = sample_specular(bsdf, at_angle(theta), 0.9999f),
                     reflected = sample_specular(bsdf, at_angle(theta), 0);
    EXPECT_NEAR(refracted.weight.g * 1.5 * 1.5, 1, 1e-5);
    EXPECT_NEAR(reflected.weight.g, 1, 1e-5);
    EXPECT_FALSE(reflected.transmitted);
  }
}

TEST(Glass, ReflectsTotallyBeyondTheCriticalAngle) {
  const BsdfSample s = sample_specular(smooth_glass(1 / 1.5f), at_angle(0.8f), 0.9999f);
  EXPECT_FALSE(s.transmitted);
  EXPECT_NEAR(s.weight.g, 1, 1e-6);
}

TEST(Glass, ThinSheetsLetLightStraightThrough) {
  Bsdf bsdf = smooth_glass(1.5f);
  bsdf.solid = false;
  const BsdfSample s = sample_specular(bsdf, at_angle(1.0f), 0.9999f);
  EXPECT_EQ(s.direction, -at_angle(1.0f));
  EXPECT_NEAR(s.weight.g, 1, 1e-5);
}

}  // namespace
}  // namespace isophote
