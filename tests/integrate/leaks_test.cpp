#include <gtest/gtest.h>

#include "integrate/stage.h"

namespace isophote::test {
namespace {

constexpr double asked = 0.05;

/// Irradiance by path tracing, the mean of two pictures; their difference says how noisy it is: the mean over blocks
/// must be a small part of the error that is allowed.
RgbImage reference_irradiance(const Stage& stage, const std::string& camera, int width, int height, int samples) {
  Job job = stage.job(method("path"), width, height, samples, camera);
  RgbImage a = render_all(job).layer("irradiance");
  job.seed = 1;
  const RgbImage b = render_all(job).layer("irradiance");
  for (std::size_t i = 0; i < a.pixels.size(); ++i) a.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
  // |b - mean of both| has the same mean as the error of the mean.
  const double noise = percentile(block_errors(b, a, 8), 0.5);
  EXPECT_LT(noise, asked / 4) << "the reference is too noisy";
  return a;
}

void expect_within_three_times(const RgbImage& cached, const RgbImage& reference, const std::string& what) {
  const std::vector<double> errors = block_errors(cached, reference, 8);
  const double p95 = percentile(errors, 0.95);
  std::printf("%s: relative error of 8x8 blocks: median %.4f, 95%% %.4f, asked %.3f\n", what.c_str(),
              percentile(errors, 0.5), p95, asked);
  EXPECT_LT(p95, 3 * asked) << what;
}

TEST(Leaks, TheClosedBoxStaysExactlyBlack) {
  const Stage stage("closed-box.glb");
  for (const char* camera : {"crate", "closet"}) {
    for (const Method& m : methods()) {
      SCOPED_TRACE(std::string(camera) + " " + m.name);
      Job job = stage.job(method(m.name, asked), 64, 48, 4, camera);
      job.strata = Strata::about(200);
      const ExrFile picture = render_all(job).exr();
      for (const char* layer : {"", "direct", "indirect", "irradiance"})
        for (const Rgb& pixel : picture.rgb(layer).pixels) ASSERT_EQ(pixel, Rgb{}) << layer;
      EXPECT_GT(mean_luminance(picture.rgb("albedo")), 0.1);
    }
  }
}

TEST(Leaks, TheDarkSideOfAThinWall) {
  const Stage stage("thin-wall.glb");
  const RgbImage reference = reference_irradiance(stage, "dark", 96, 72, 128);
  const RgbImage cached = render_all(stage.job(method("cached", asked), 96, 72, 16, "dark")).layer("irradiance");
  expect_within_three_times(cached, reference, "dark room");
}

/// Records of the bright room are there too, up to 2 cm away, as when one cache serves a walk through both.
TEST(Leaks, TheDarkSideOfAThinWallWithTheBrightSidesRecords) {
  const Stage stage("thin-wall.glb");
  const RgbImage reference = reference_irradiance(stage, "dark", 96, 72, 128);
  const Job bright = stage.job(method("cached", asked), 96, 72, 16, "bright");
  const Job dark = stage.job(method("cached", asked), 96, 72, 16, "dark");
  RecordCache cache = empty_cache(bright);
  build_in_rounds(bright, cache);
  build_in_rounds(dark, cache);
  Film film(dark.width, dark.height);
  render(dark, &cache, film);
  expect_within_three_times(film.irradiance(), reference, "dark room after the bright one");
}

TEST(Leaks, UnderThePlate) {
  for (const char* scene : {"plate.toml", "plate-sun.toml"}) {
    SCOPED_TRACE(scene);
    const Stage stage(scene);
    const RgbImage reference = reference_irradiance(stage, "under", 96, 72, 128);
    const RgbImage cached = render_all(stage.job(method("cached", asked), 96, 72, 16, "under")).layer("irradiance");
    expect_within_three_times(cached, reference, std::string("under ") + scene);
  }
}

TEST(Leaks, TheCornerOfThreePlanes) {
  const Stage stage("corner.glb");
  const RgbImage reference = reference_irradiance(stage, "corner", 96, 72, 128);
  const RgbImage cached = render_all(stage.job(method("cached", asked), 96, 72, 16, "corner")).layer("irradiance");
  expect_within_three_times(cached, reference, "corner");
}

TEST(TwoSidedWall, EachSideHasItsOwnRecordsAndLight) {
  const Stage stage("back-wall.glb");
  const Job front = stage.job(method("cached", asked), 96, 72, 16, "front");
  const Job back = stage.job(method("cached", asked), 96, 72, 16, "back");
  RecordCache cache = empty_cache(front);
  build_in_rounds(front, cache);
  build_in_rounds(back, cache);

  int towards_front = 0, towards_back = 0;
  for (const Record& r : cache.records()) {
    if (std::abs(r.position.x - 3) > 1e-4f) continue;
    towards_front += r.normal.x < -0.99f, towards_back += r.normal.x > 0.99f;
  }
  EXPECT_GT(towards_front, 5);
  EXPECT_GT(towards_back, 5);

  for (const Job* job : {&front, &back}) {
    Film film(job->width, job->height);
    render(*job, &cache, film);
    const RgbImage reference = reference_irradiance(stage, job->camera.name, job->width, job->height, 128);
    expect_within_three_times(film.irradiance(), reference, job->camera.name + " of the wall");
  }
}

}  // namespace
}  // namespace isophote::test
