#include <gtest/gtest.h>

#include <cmath>

#include "render.h"
#include "support/scenes.h"

namespace isophote {
namespace {

// Light sampling cannot know what is hidden. Close to a lamp BSDF rays help where it chooses badly.
TEST(DirectLight, ALampUpCloseIsNotNoisyBesideAStrongHiddenOne) {
  for (const float height : {0.3f, 0.05f, 0.01f}) {
    Scene scene;
    const int floor = scenes::add(scene, scenes::diffuse(Rgb(0.5f)));
    const int weak = scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(3.0f)));
    const int strong = scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1e4f)));
    scene.meshes = {scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, floor),
                    scenes::quad({-0.5f, height, -0.5f}, {1, 0, 0}, {0, 0, 1}, weak),
                    scenes::quad({-2, -1, 2}, {4, 0, 0}, {0, 0, -4}, strong)};  // under the floor, facing up
    Stage stage(scene);
    const SurfacePoint point = stage.hit({0.1f, 0.5f * height, 0.2f}, {0, -1, 0});
    EXPECT_TRUE(stage.emitters.near(point.position));
    statistics::Estimate light;
    constexpr int samples = 10000;
    for (int i = 0; i < samples; ++i) {
      Sampler sampler = test_sampler(1, i);
      light.add(direct_light(stage.world, point, {0, 1, 0}, false, sampler, stage.counts).g);
    }
    EXPECT_LT(light.standard_error() * std::sqrt(static_cast<double>(samples)), 0.8 * light.mean()) << height;
    EXPECT_GT(light.mean(), 0.5 * 0.5 * 3) << height;
  }
}

}  // namespace
}  // namespace isophote
