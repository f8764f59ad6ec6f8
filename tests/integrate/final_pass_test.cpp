#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote::test {
namespace {

/// The room of scenes.h with a glossy metal block and a coat on the other: every branch of the cached integrator.
Scene glossy_room() {
  Scene scene = scenes::cornell_box();
  scene.meshes[6].material = scenes::add(scene, scenes::metal({0.9f, 0.7f, 0.4f}, 0.45f));
  Material coated = scenes::diffuse({0.3f, 0.5f, 0.7f});
  coated.specular = 1, coated.roughness = 0.3f;
  scene.meshes[7].material = scenes::add(scene, coated);
  return scene;
}

TEST(Uncovered, AnEmptyCacheGivesThePathTracedPictureAndCountsEverySample) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached"), 48, 48, 4);
  Film film(job.width, job.height);
  const RecordCache nothing = empty_cache(job);
  const RenderReport report = render(job, &nothing, film);

  job.method = method("path");
  const ExrFile reference = render_all(job).exr(), picture = film.exr();
  EXPECT_TRUE(exr_bytes(picture) == exr_bytes(reference));
  double on_surfaces = 0;
  for (const float alpha : reference.find("A")->values) on_surfaces += job.samples * static_cast<double>(alpha);
  EXPECT_EQ(static_cast<double>(report.uncovered), on_surfaces);
  EXPECT_GT(on_surfaces, 0);
}

TEST(Uncovered, AFullCacheLeavesNextToNone) {
  const Stage stage("cornell-box.glb");
  const Job job = stage.job(method("cached", 0.05), 64, 64, 4);
  const Rendered r = render_all(job);
  EXPECT_LT(static_cast<double>(r.final.uncovered), 5e-3 * 64 * 64 * 4);
}

/// Block by block and as a whole, no further from the reference than its noise and the error asked for allow.
void expect_same_light(const RgbImage& picture, const RgbImage& path, const RgbImage& other_path, double asked) {
  const Difference noise = compare(other_path, path), difference = compare(picture, path);
  EXPECT_LT(std::abs(difference.bias), std::max(2 * std::abs(noise.bias), asked / 2));
  EXPECT_LT(difference.block_error, noise.block_error + asked);
}

TEST(CachedIntegrator, AgreesWithPathTracingOnGlossySurfaces) {
  const Stage stage(glossy_room());
  constexpr double asked = 0.02;
  Job job = stage.job(method("path"), 64, 64, 256);
  const ExrFile path = render_all(job).exr();
  job.seed = 1;
  const ExrFile other = render_all(job).exr();
  const ExrFile cached = render_all(stage.job(method("cached", asked), 64, 64, 64)).exr();
  for (const char* layer : {"", "direct", "indirect", "irradiance"}) {
    SCOPED_TRACE(layer);
    expect_same_light(cached.rgb(layer), path.rgb(layer), other.rgb(layer), asked);
  }
}

TEST(CachedIntegrator, ChainsBetweenBrightMetalsEnd) {
  Scene scene = scenes::room(scenes::metal(Rgb(1), 0.2f));
  scene.lights.emplace_back().position = {0.3f, 0.2f, 0.1f};
  const Stage stage(std::move(scene));
  const Job job = stage.job(method("cached"), 16, 16, 4);
  EXPECT_GT(mean_luminance(render_all(job).layer("indirect")), 0);
}

TEST(CachedIntegrator, SeesTheSameFirstPointsAsPathTracing) {
  const Stage stage(glossy_room());
  Job job = stage.job(method("cached", 0.05), 48, 48, 4);
  job.strata = Strata::about(50);
  const ExrFile cached = render_all(job).exr();
  job.method = method("path");
  const ExrFile path = render_all(job).exr();
  for (const char* name : {"A", "depth.Z", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"})
    EXPECT_TRUE(cached.find(name)->values == path.find(name)->values) << name;
}

TEST(MaxDepth, OneIsDirectLightAloneAndMakesNoRecords) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("bounded"), 48, 48, 4);
  job.world.max_depth = 1;
  const Rendered cached = render_all(job);
  EXPECT_TRUE(cached.cache.records().empty());
  job.method = method("path");
  const Rendered path = render_all(job);
  EXPECT_TRUE(exr_bytes(cached.exr()) == exr_bytes(path.exr()));
  EXPECT_EQ(mean_luminance(path.layer("indirect")), 0);
  EXPECT_GT(mean_luminance(path.layer("direct")), 0.01);
}

/// Light of the sky scattered once is indirect; what a mirror shows has one event less left.
TEST(MaxDepth, HoldsForSkyAndMirrorsAsForPaths) {
  const Stage plate("plate.toml"), gallery("gallery.glb");
  for (const auto& [stage, camera, depth] : {std::tuple{&plate, "", 1}, {&plate, "", 2}, {&gallery, "mirror", 3}}) {
    SCOPED_TRACE(depth);
    Job job = stage->job(method("bounded"), 64, 48, 128, camera);
    job.strata = Strata::about(800);
    job.world.max_depth = depth;
    const double cached = mean_luminance(render_all(job).layer("indirect"));
    job.method = method("path");
    job.seed = 3;
    const double path = mean_luminance(render_all(job).layer("indirect"));
    EXPECT_NEAR(cached / path, 1, 0.015);
  }
}

/// In a furnace each event after the first adds one term to the series.
TEST(MaxDepth, CutsTheSeriesForCachesAsForPaths) {
  const Stage stage(scenes::room(scenes::emissive(Rgb(0.5f), Rgb(1))));
  for (const int depth : {2, 3}) {
    SCOPED_TRACE(depth);
    const double truth = M_PI * (depth == 2 ? 0.5 : 0.75);
    for (const char* name : {"path", "bounded"}) {
      SCOPED_TRACE(name);
      Job job = stage.job(method(name), 32, 32, 16);
      job.world.max_depth = depth;
      EXPECT_NEAR(mean_luminance(render_all(job).layer("irradiance")) / truth, 1, 0.01);
    }
  }
}

TEST(Film, RowsMayHaveDifferentNumbersOfSamples) {
  Film film(1, 2);
  PixelSample seen;
  seen.direct = Rgb(1), seen.indirect = Rgb(2), seen.alpha = 1, seen.depth = 3;
  PixelSample sky;
  sky.direct = Rgb(5);
  film.add(0, 0, seen);
  film.finish_row(0, 1);
  film.add(0, 1, seen), film.add(0, 1, sky);
  film.finish_row(1, 2);
  const ExrFile file = film.exr();
  EXPECT_EQ(file.rgb("").pixels[0], Rgb(3));
  EXPECT_EQ(file.rgb("").pixels[1], Rgb(4));
  EXPECT_EQ(file.find("A")->values, (std::vector<float>{1, 0.5f}));
  // Depth is that of what was hit; the sky has none.
  EXPECT_EQ(file.find("depth.Z")->values, (std::vector<float>{3, 3}));
}

}  // namespace
}  // namespace isophote::test
