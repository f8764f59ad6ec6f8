#include "isophote/scene/lamp_sampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using Among = Emitters::Among;
using statistics::Random;

TEST(Emitters, FewAreChosenByWhatTheyMaySend) {
  // Near a strip twenty times longer than its distance every sample brings about the same.
  Scene scene;
  scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(2.0f)));
  scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(0.001f)));
  scene.meshes = {scenes::quad({-10, 1, 0}, {20, 0, 0}, {0, 0, 0.1f}, 0),
                  scenes::quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1)};
  const Emitters emitters(scene);
  for (const float x : {-9.0f, 0.0f, 4.0f}) {
    statistics::Estimate irradiance;
    Random random(12);
    for (int i = 0; i < 4000; ++i) {
      const float choice = random.next();
      const LightSample s = emitters.sample({x, 0, 0}, choice, random.next2());
      irradiance.add(s.pdf > 0 ? s.radiance.r * std::max(0.0f, s.direction.y) / s.pdf : 0);
    }
    EXPECT_LT(irradiance.standard_error() * std::sqrt(4000.0), 0.5 * irradiance.mean()) << x;
  }
}

TEST(Emitters, NearIsConservative) {
  // Wherever a cosine-distributed ray could meet a lamp with four times the density of light sampling, near() holds.
  Scene scene = scenes::cornell_box();
  for (Mesh& mesh : scene.meshes)
    if (!is_black(scene.materials[mesh.material].emission)) mesh = scenes::divided(mesh, 5);
  const Emitters emitters(scene);
  Random random(3);
  int near = 0, needed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 from{2 * random.next() - 1, 2 * random.next(), 2 * random.next() - 1};
    bool needs = false;
    for (int k = 0; k < 16; ++k) {
      const LightSample s = emitters.sample(from, random.next(), random.next2(), Among::sampled_directly);
      needs |= s.pdf > 0 && 1 / pi > 4 * s.pdf;
    }
    needed += needs;
    near += emitters.near(from);
    EXPECT_TRUE(!needs || emitters.near(from));
  }
  EXPECT_GT(needed, 0);
  EXPECT_LT(near, 20000 / 5);
}

}  // namespace
}  // namespace isophote
