#include <gtest/gtest.h>

#include <cmath>

#include "lit_floor.h"
#include "render.h"
#include "support/polygon_irradiance.h"

namespace isophote {
namespace {

/// Radiance towards `wo` of the lamp of `floor_with_lamp`, by quadrature over its area.
double reflected_lamp(const SurfacePoint& point, const Vec3& wo, double height) {
  const Vec3d at(point.position), up{0, 1, 0};
  const double diffuse = diffuse_albedo(point.bsdf, wo).g / M_PI;
  const auto scattered = [&](const Vec3d& y) {
    const Vec3d wi = normalize(y - at);
    return 3 * (diffuse + evaluate_glossy(point.bsdf, wo, Vec3(wi)).g / wi.y);  // without the cosine that it has
  };
  double sum = 0;
  constexpr int pieces = 8;  // a side, so that each sees little of a lobe
  for (int i = 0; i < pieces; ++i)
    for (int k = 0; k < pieces; ++k) {
      const double x = -0.5 + 1.0 * i / pieces, z = -0.5 + 1.0 * k / pieces, side = 1.0 / pieces;
      const test::Polygon piece{
          {x, height, z}, {x + side, height, z}, {x + side, height, z + side}, {x, height, z + side}};
      sum += test::gauss_integral(at, up, piece, scattered);
    }
  return sum;
}

// Direct light of both lobes, of which cached pictures are made, and as `scatter` has it: far from the lamp, by light
// samples alone, and near, where each lobe's ray helps; the mirror direction inside the lamp and beside it.
TEST(DirectLight, OfBothLobesMatchesQuadrature) {
  for (const double alpha : {0.15, 0.3, 0.6})
    for (const float height : {2.0f, 0.25f, 0.05f})
      for (const Vec3& wo : {normalize(Vec3{0.3f, 1, 0.1f}), normalize(Vec3{0.9f, 0.5f, 0.1f})}) {
        SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", lamp at " << height << ", wo.x " << wo.x);
        Stage stage(floor_with_lamp(shiny(static_cast<float>(std::sqrt(alpha))), height));
        const SurfacePoint point = stage.hit(Vec3{0.3f, 0, 0} + wo * (0.5f * height), -wo);
        EXPECT_EQ(stage.emitters.near(point.position), height < 0.3f);
        statistics::Estimate parts, whole;
        for (int i = 0; i < 40000; ++i) {
          Sampler a = test_sampler(1, i), b = test_sampler(2, i);
          parts.add(direct_light(stage.world, point, wo, true, a, stage.counts).g);
          whole.add(scatter(stage.world, point, wo, 0, b, stage.counts).direct.g);
        }
        const double truth = reflected_lamp(point, wo, height);
        std::printf("  alpha %.2f, lamp at %.2f, wo.x %.1f: %.4f, %+.2f standard errors of %.2f%%\n", alpha, height,
                    wo.x, truth, (parts.mean() - truth) / parts.standard_error(), 100 * parts.standard_error() / truth);
        expect_mean(parts, truth, 0.01);
        expect_mean(whole, truth, 0.01);
      }
}

}  // namespace
}  // namespace isophote
