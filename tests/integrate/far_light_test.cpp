#include "isophote/integrate/far_light.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/integrate/pilot.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

/// The mean luminance of indirect irradiance, by paths and as the default method has it: within half a percent, and
/// what two path-traced pictures differ by.
void expect_mean_level(const std::string& scene, Secondary secondary, int width, int height, int samples) {
  SCOPED_TRACE(scene);
  const Stage stage(scene);
  const auto path = [&](std::uint64_t seed) {
    Job job = stage.job(method("path"), width, height, samples);
    job.seed = seed;
    return mean_luminance(render_all(job).layer("irradiance"));
  };
  const double first = path(1), second = path(2), truth = (first + second) / 2;
  constexpr int seeds = 4;
  double mean = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Method how = method("cached", 0.05);
    how.secondary = secondary;
    Job job = stage.job(how, width, height, 4);
    job.seed = static_cast<std::uint64_t>(seed);
    job.strata = Strata::about(800);
    mean += mean_luminance(render_all(job).layer("irradiance")) / seeds;
  }
  std::printf("%s, %s: %+.3f %% of paths, two of which differ by %.2f %%\n", scene.c_str(),
              std::string(name_of(secondary)).c_str(), 100 * (mean / truth - 1), 100 * std::abs(first / second - 1));
  EXPECT_NEAR(mean / truth, 1, 0.005 + std::abs(first / second - 1));
}

TEST(FarLight, KeepsTheMeanLevelOfTheCornellBox) {
  for (const Secondary s : {Secondary::cells, Secondary::records}) expect_mean_level("cornell-box.glb", s, 64, 64, 128);
}

TEST(SlowFarLight, KeepsTheMeanLevelOfAllScenes) {
  for (const char* scene : {"cornell-box.glb", "contact-shadow.glb", "gallery.glb", "sphere.glb", "corner.glb",
                            "plate.toml", "back-wall.glb", "thin-wall.glb", "atrium.glb"})
    expect_mean_level(scene, Secondary::automatic, 96, 72, 1024);
}

/// Walls with both lobes, whose chains would branch without end: they do not, and keep the level of paths, of bright
/// metals too.
TEST(FarLight, ChainsBetweenGlossyWallsEnd) {
  for (const float metallic : {0.5f, 0.9f}) {
    Scene scene = scenes::cornell_box();
    for (Material& material : scene.materials) material.metallic = metallic, material.roughness = 0.5f;
    const Stage stage(std::move(scene));
    const double truth = mean_luminance(render_all(stage.job(method("path"), 48, 48, 512)).layer("irradiance"));
    double mean = 0;
    constexpr int seeds = 4;
    for (int seed = 0; seed < seeds; ++seed) {
      Method how = method("cached", 0.05);
      how.secondary = Secondary::cells;
      Job job = stage.job(how, 48, 48, 4);
      job.seed = static_cast<std::uint64_t>(seed);
      job.strata = Strata::about(400);
      mean += mean_luminance(render_all(job).layer("irradiance")) / seeds;
    }
    std::printf("metallic %.1f: %+.2f %% of paths\n", metallic, 100 * (mean / truth - 1));
    EXPECT_NEAR(mean / truth, 1, 0.02) << metallic;
  }
}

TEST(Seeding, FindsCellsBetterThanPathsIndoors) {
  for (const char* scene : {"cornell-box.glb", "atrium.glb"}) {
    const Stage stage(scene);
    Job job = stage.job(method("cached", 0.05), 32, 32, 1);
    RecordCache cache = empty_cache(job);
    RayCounts counts;
    const Seeding seeding = seed_cells(job, cache, counts);
    std::printf("%s: %.2f\n", scene, seeding.gain);
    EXPECT_EQ(seeding.chosen, Secondary::records);
    EXPECT_GT(seeding.gain, 1.2);  // 1.3 to 1.5 over seeds in the box
    EXPECT_GT(counts.gather, 0u);
    // Once there are cells, nothing is cast to decide again.
    const std::uint64_t before = counts.total();
    EXPECT_EQ(seed_cells(job, cache, counts).chosen, Secondary::records);
    EXPECT_EQ(counts.total(), before);
  }
}

TEST(Seeding, AsksNothingWherePathsGoOn) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("ward1992"), 32, 32, 1);
  RecordCache cache = empty_cache(job);
  RayCounts counts;
  EXPECT_EQ(seed_cells(job, cache, counts).chosen, Secondary::off);
  EXPECT_EQ(counts.total(), 0u);
}

/// The floor of two rooms of which one is twenty times as bright, 2 cm apart: one cell lies in both.
TEST(TakeIn, KeepsWhatAWallPartsOutOfACell) {
  const Stage stage("thin-wall.glb");
  const World world = stage.world();
  IrradianceCells cells(stage.scene().bounds());
  const auto sample = [&](const Vec3& p, float value) {
    IrradianceCells::Cell cell{.key = cells.key(p, {0, 1, 0}, 100), .count = 1, .sum = Rgb(value)};
    cell.position = p, cell.normal = {0, 1, 0};
    return cell;
  };
  const auto bright = sample({2.99f, 0, 1.5f}, 20), beside = sample({2.95f, 0, 1.51f}, 20),
             dark = sample({3.03f, 0, 1.5f}, 1);
  ASSERT_TRUE(bright.key == dark.key && bright.key == beside.key);
  RayCounts counts;
  std::vector<IrradianceCells> left(3);
  left[0].add(bright), left[1].add(dark), left[2].add(beside);
  take_in(world, cells, left, counts);
  ASSERT_EQ(cells.cells().size(), 1u);
  EXPECT_EQ(cells.cells()[0].count, 2u);
  EXPECT_EQ(cells.cells()[0].sum, Rgb(40));
  EXPECT_EQ(cells.cells()[0].position, bright.position);
  EXPECT_TRUE(cells.cells()[0].cut);
}

}  // namespace
}  // namespace isophote::test
