#include "isophote/integrate/check_points.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/integrate/make_record.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

/// Irradiance of exactly pi everywhere: what a gather of a plane under an even sky measures has no noise.
Scene plane_under_sky() {
  Scene scene;
  scene.meshes = {scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, scenes::add(scene, scenes::diffuse(Rgb(0.5f))))};
  scene.environment.radiance = RgbImage(8, 4, Rgb(1));
  scene.cameras.push_back(Camera::look_at({0, 2, 6}, {0, 0, 0}, 1.2f));
  return scene;
}

RecordCache scaled(const RecordCache& cache, float factor) {
  RecordCache result(cache.bounds());
  for (Record record : cache.records()) {
    record.jet.value *= factor;
    result.insert(record);
  }
  return result;
}

TEST(CheckPoints, MeasuresWhatAScaledCacheIsOffBy) {
  const Stage stage(plane_under_sky());
  const Job job = stage.job(method("cached"), 64, 64, 1);
  const RecordCache cache = render_all(job).cache;
  for (const float factor : {1.0f, 1.1f, 0.8f}) {
    SCOPED_TRACE(factor);
    const double off = std::abs(factor - 1) / 1.01;  // of E + 0.01 mean E
    const MeasuredError error = check_points(job, scaled(cache, factor), 1000000);
    EXPECT_GE(error.points, 100);
    EXPECT_NEAR(error.mean, off, 1e-5);
    EXPECT_NEAR(error.median, off, 1e-5);
    EXPECT_NEAR(error.p95, off, 1e-5);
    EXPECT_NEAR(error.bias, factor - 1, 1e-5);
    EXPECT_NEAR(error.noise, 0, 1e-6);
  }
}

TEST(CheckPoints, SayWhereTheLargestErrorIsSeen) {
  const Stage stage(plane_under_sky());
  const Job job = stage.job(method("uniform", 0.1), 64, 64, 1);
  RecordCache cache = render_all(job).cache;
  for (Record& record : cache.settling().records)
    if (record.position.x > 0) record.jet.value *= 1.5f;
  const MeasuredError error = check_points(job, cache, 1000000);
  EXPECT_NEAR(error.largest, 0.5 / 1.01, 1e-3);
  Sampler stream(1, 0);
  RayCounts counts;
  const auto x = static_cast<float>(error.largest_x), y = static_cast<float>(error.largest_y);
  const Ray ray = job.camera.ray(x + 0.5f, y + 0.5f, job.width, job.height);
  const auto place = place_of(job, first_point(job.world, ray, true, stream, counts.camera));
  ASSERT_TRUE(place);
  EXPECT_GT(place->position.x, 0);
}

TEST(CheckPoints, InAFurnaceMeasureNoMoreThanNoise) {
  const Stage stage(scenes::room(scenes::emissive(Rgb(0.5f), Rgb(1))));
  Job job = stage.job(method("uniform", 0.1), 32, 32, 1);
  job.strata = Strata::about(3000);
  RecordCache cache = render_all(job).cache;
  // The truth, in place of what the records hold.
  for (Record& record : cache.settling().records) {
    Jet<Rgb> truth;
    truth.value = Rgb(pi);
    record.jet = truth;
  }
  const MeasuredError error = check_points(job, cache, 4000000);
  EXPECT_GT(error.noise, 0);
  EXPECT_LT(error.noise, 0.02);
  // Both are means of |normal|, whose relative deviation is 0.76.
  EXPECT_NEAR(error.mean / error.noise, 1, 4.5 * 0.76 * std::sqrt(2.0 / error.points));
  EXPECT_LT(std::abs(error.bias), 4.5 * 1.26 * error.noise / std::sqrt(error.points));
}

TEST(CheckPoints, ABudgetDecidesTheirNumberWithinLimits) {
  const Stage stage(plane_under_sky());
  const Job job = stage.job(method("cached"), 64, 64, 1);
  const RecordCache cache = render_all(job).cache;
  const MeasuredError least = check_points(job, cache, 0), most = check_points(job, cache, 1ull << 40);
  EXPECT_LE(least.points, 40);
  EXPECT_GT(least.points, 8);
  EXPECT_GT(most.points, 256);
  EXPECT_LE(most.points, 1024);
  for (const MeasuredError& e : {least, most}) {
    EXPECT_EQ(e.rays.total(), e.rays.check) << "rays of checks are counted as such alone";
    EXPECT_GT(e.rays.check, 3000u * static_cast<unsigned>(e.points));
  }
  const std::uint64_t budget = 1000000;
  EXPECT_NEAR(static_cast<double>(check_points(job, cache, budget).rays.check), budget, 0.2 * budget);
}

TEST(CheckPoints, AnEmptyCacheCannotBeMeasured) {
  const Stage stage(plane_under_sky());
  const Job job = stage.job(method("cached"), 64, 64, 1);
  EXPECT_EQ(check_points(job, empty_cache(job), 100000).points, 0);
}

TEST(CheckPoints, ABlackSceneIsRightExactly) {
  const Stage stage(scenes::room(scenes::diffuse(Rgb(0.5f))));
  const Job job = stage.job(method("cached"), 32, 32, 1);
  const MeasuredError error = check_points(job, render_all(job).cache, 0);
  EXPECT_GT(error.points, 0);
  EXPECT_EQ(error.mean, 0);
  EXPECT_EQ(error.bias, 0);
}

}  // namespace
}  // namespace isophote::test
