#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

/// Equal bit for bit but for depth, which is `scale` times as large.
void expect_scaled(const ExrFile& picture, const ExrFile& base, float scale) {
  ASSERT_EQ(picture.channels.size(), base.channels.size());
  for (std::size_t c = 0; c < base.channels.size(); ++c) {
    const auto& [name, values] = base.channels[c];
    ASSERT_EQ(picture.channels[c].name, name);
    const float factor = name == "depth.Z" ? scale : 1;
    std::size_t different = 0;
    for (std::size_t i = 0; i < values.size(); ++i) different += picture.channels[c].values[i] != values[i] * factor;
    EXPECT_EQ(different, 0u) << "pixels of " << name << " at scale " << scale;
  }
}

Rendered small_picture(const Stage& stage, const char* name, std::uint64_t seed = 0) {
  Job job = stage.job(method(name, 0.05), 48, 48, 2);
  job.strata = Strata::about(200);
  job.seed = seed;
  return render_all(job);
}

void expect_exact_scaling(const Stage& base, const Stage& scaled, float scale) {
  for (const char* name : {"cached", "bounded", "path"}) {
    SCOPED_TRACE(name);
    const Rendered a = small_picture(scaled, name), b = small_picture(base, name);
    EXPECT_EQ(a.cache.records().size(), b.cache.records().size());
    expect_scaled(a.exr(), b.exr(), scale);
  }
}

TEST(Scale, PowersOfTwoGiveTheSameCornellBox) {
  const Stage base("cornell-box.glb");
  expect_exact_scaling(base, Stage("cornell-box-over-1024.glb"), 0x1p-10f);
  expect_exact_scaling(base, Stage("cornell-box-times-8192.glb"), 0x1p13f);
}

/// Intensities of a point and a spot light scale with the square of lengths.
Scene room_with_lights(float s) {
  Scene scene = scenes::cornell_box(s);
  PunctualLight point;
  point.position = Vec3{-0.6f, 1.7f, 0.7f} * s;
  point.intensity = Rgb(0.7f, 1.3f, 2.1f) * (s * s);
  PunctualLight spot = point;
  spot.kind = PunctualLight::Kind::spot;
  spot.position = Vec3{0.6f, 1.8f, 0.8f} * s;
  spot.direction = normalize(Vec3{-0.5f, -1, -0.9f});
  spot.range = 4 * s;
  scene.lights = {point, spot};
  return scene;
}

TEST(Scale, PowersOfTwoGiveTheSameRoomWithPunctualLights) {
  const Stage base(room_with_lights(1));
  expect_exact_scaling(base, Stage(room_with_lights(0x1p-10f)), 0x1p-10f);
  expect_exact_scaling(base, Stage(room_with_lights(0x1p13f)), 0x1p13f);
}

// Other factors round differently: a few rays near an edge fall on its other side, and whatever is chosen after them
// differs. The picture may then be as far from the base as one of another seed is, but has the same mean.
void expect_statistically_equal(const char* name, const char* scaled_file) {
  SCOPED_TRACE(std::string(name) + " " + scaled_file);
  const Stage base("cornell-box.glb"), scaled(scaled_file);
  const RgbImage truth = small_picture(base, name).layer(""), other_seed = small_picture(base, name, 1).layer("");
  const RgbImage picture = small_picture(scaled, name).layer("");
  const Difference seeds = compare(other_seed, truth), scales = compare(picture, truth);
  EXPECT_LT(scales.block_error, 1.3 * seeds.block_error);
  EXPECT_LT(scales.rmse, 1.3 * seeds.rmse);
  EXPECT_LT(std::abs(scales.bias), std::max(std::abs(seeds.bias), 0.005));
}

TEST(Scale, OtherFactorsGiveThePictureOfAnotherSeed) {
  for (const char* name : {"cached", "bounded", "path"})
    for (const char* file : {"cornell-box-over-1000.glb", "cornell-box-times-10000.glb"})
      expect_statistically_equal(name, file);
}

}  // namespace
}  // namespace isophote::test
