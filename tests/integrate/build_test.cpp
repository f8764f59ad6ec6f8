#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/integrate/jet_memo.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/pilot.h"
#include "isophote/integrate/solve_records.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

TEST(Build, AConvexSurfaceReusesRecords) {
  const Stage stage("sphere.glb");
  Job job = stage.job(method("cached", 0.05), 96, 96, 1);
  job.method.settings.bounds.max_view = infinity;  // so that the surface decides
  const Rendered r = render_all(job);
  const Vec3 center{0.3f, 0.5f, -0.2f};
  const auto on_sphere = [&](const Vec3& p) { return length(p - center) < 0.502f; };

  int points = 0, covered = 0;
  RayCounts counts;
  for (int y = 0; y < job.height; ++y)
    for (int x = 0; x < job.width; ++x) {
      Sampler stream = job.sampler(x, y, 0);
      const FirstPoint seen = first_point(job.world, job.camera_ray(x, y, stream), true, stream, counts.camera);
      const std::optional<Place> place = place_of(job, seen);
      if (!place || !on_sphere(place->position)) continue;
      ++points;
      covered += r.cache.covers({place->position, place->normal, place->normal});
    }
  int records = 0;
  for (const Record& record : r.cache.records()) records += on_sphere(record.position);
  std::printf("sphere: %d points, %d covered, %d records\n", points, covered, records);
  EXPECT_GT(points, 500);
  EXPECT_GE(covered, 0.998 * points);
  EXPECT_GT(records, 10);
  EXPECT_LT(records, points / 10);
}

TEST(Build, RecordsLieOnSurfacesAndServeTheirOwnPlace) {
  const Stage stage("cornell-box.glb");
  const Rendered r = render_all(stage.job(method("cached", 0.05), 48, 48, 1));
  const Box bounds = stage.scene().bounds();
  for (const Record& record : r.cache.records()) {
    EXPECT_NEAR(length(record.normal), 1, 1e-5);
    EXPECT_TRUE(is_finite(record.jet.value));
    EXPECT_GE(std::min({record.jet.value.r, record.jet.value.g, record.jet.value.b}), 0);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(record.position[axis], bounds.lower[axis] - 1e-4f);
      EXPECT_LE(record.position[axis], bounds.upper[axis] + 1e-4f);
    }
    EXPECT_LT(footprint_error(record, record.position, record.normal), 1e-3f);
  }
}

TEST(Build, FourTimesThePixelsNeedFewMoreRecords) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached", 0.05), 128, 128, 1);
  job.strata = Strata::about(50);
  const auto few = static_cast<double>(render_all(job).cache.records().size());
  job.width = job.height = 256;
  const auto many = static_cast<double>(render_all(job).cache.records().size());
  std::printf("cached: %.0f records at 128x128, %.0f at 256x256\n", few, many);
  EXPECT_LT(many, 1.3 * few);
}

TEST(Build, ASmallerErrorTakesMoreRecords) {
  const Stage stage("cornell-box.glb");
  std::size_t before = 0;
  for (const double error : {0.2, 0.05, 0.0125}) {
    Job job = stage.job(method("cached", error), 64, 64, 1);
    job.strata = Strata::about(50);
    const std::size_t records = render_all(job).cache.records().size();
    EXPECT_GT(records, before);
    before = records;
  }
}

TEST(BuildWithRecords, ComesWithinFivePercent) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"cached", "ward1992", "uniform"})
    for (const std::size_t wanted : {600u, 900u}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(wanted));
      Job job = stage.job(method(name), 96, 96, 1);
      job.strata = Strata::about(30);
      const float a_before = job.method.settings.a;
      const Solved solved = build_with_records(job, wanted);
      const auto records = static_cast<double>(solved.cache.records().size());
      EXPECT_NEAR(records / static_cast<double>(wanted), 1, 0.05);
      EXPECT_NE(job.method.settings.a, a_before);
      // The threshold it leaves is the one that made this cache.
      RecordCache again = empty_cache(job);
      const BuildReport report = build_in_rounds(job, again);
      EXPECT_TRUE(record_bytes(again) == record_bytes(solved.cache));
      EXPECT_EQ(report.rounds, solved.report.rounds);
      EXPECT_GE(solved.report.rays.total(), report.rays.total());
    }
}

TEST(BuildWithRecords, FindsThresholdsFarBelowAThousandth) {
  const Stage stage("contact-shadow.glb");  // so smooth that records are many at small thresholds alone
  Job job = stage.job(method("jarosz2012"), 64, 64, 1);
  job.strata = Strata::about(400);
  const Solved solved = build_with_records(job, 900);
  EXPECT_LT(job.method.settings.a, 1e-3f);
  EXPECT_NEAR(static_cast<double>(solved.cache.records().size()), 900, 45);
}

TEST(BuildWithRecords, StopsWhereNoThresholdGivesAsFew) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached"), 48, 48, 1);
  job.strata = Strata::about(30);
  job.method.settings.a = greatest_threshold / 2;
  const BuildReport first = render_all(job).build;
  const Solved solved = build_with_records(job, 1);
  EXPECT_EQ(job.method.settings.a, greatest_threshold);
  EXPECT_GT(solved.cache.records().size(), 1u);
  EXPECT_LT(solved.report.rays.gather, 2 * first.rays.gather);  // the first try and the last possible one
}

// What other methods and thresholds asked for before changes no bit, and is not gathered again.
TEST(JetMemo, RecordsAreTheSameWithAndWithout) {
  const Stage stage("cornell-box.glb");
  JetMemo memo({&find_estimator("irradiance"), &find_estimator("ward-heckbert-exact"), &find_estimator("swept-edges")});
  for (const char* name : {"ward1988", "bounded", "swept"}) {
    SCOPED_TRACE(name);
    Job job = stage.job(method(name, 0.1), 64, 64, 1);
    job.strata = Strata::about(100);
    const Rendered fresh = render_all(job);
    job.memo = &memo;
    const Rendered first = render_all(job), second = render_all(job);
    EXPECT_TRUE(record_bytes(first.cache) == record_bytes(fresh.cache));
    EXPECT_TRUE(record_bytes(second.cache) == record_bytes(fresh.cache));
    EXPECT_LE(first.build.rays.gather, fresh.build.rays.gather);
    EXPECT_LT(second.build.rays.gather, fresh.build.rays.gather / 2);  // a pilot's at most
  }
}

TEST(LazyOrder, CoversEverythingWithAboutTheRecordsOfRounds) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"ward1992", "cached"}) {
    SCOPED_TRACE(name);
    Job job = stage.job(method(name, 0.05), 96, 96, 2);
    job.strata = Strata::about(400);
    const Rendered rounds = render_all(job);
    RecordCache cache = empty_cache(job);
    Film film(job.width, job.height);
    const LazyReport lazy = render_lazily(job, cache, film);
    EXPECT_EQ(lazy.final.uncovered, 0u);
    EXPECT_FALSE(lazy.final.cancelled);
    const std::size_t surveyed = wants_survey(job.method) ? surveyed_places : 0;
    EXPECT_EQ(lazy.build_rays.camera > 0, surveyed > 0);
    // One gather ray a stratum, and those that go on through mirrors, of which there are none here.
    const std::size_t seeded = cache.cells().cells().empty() ? 0 : 2 * surveyed_places * Strata::about(200).size();
    EXPECT_LE(lazy.build_rays.gather, (cache.records().size() + surveyed) * job.strata.size() + seeded);
    EXPECT_GE(lazy.build_rays.gather, cache.records().size() * job.strata.size());
    const double surplus =
        static_cast<double>(rounds.cache.records().size()) / static_cast<double>(cache.records().size());
    std::printf("%s: rounds have %.3f times the records of the lazy order\n", name, surplus);
    // Both cover the same samples.
    EXPECT_GT(surplus, 0.6);
    EXPECT_LT(surplus, 1.15);
    // What is covered and surveyed takes next to no more rays: a record that came later may have shrunk one before it.
    job.pilot = lazy.pilot;
    Film same(job.width, job.height);
    const LazyReport again = render_lazily(job, cache, same);
    EXPECT_LT(again.build_rays.gather, lazy.build_rays.gather / 100);
    EXPECT_EQ(again.pilot, lazy.pilot);
    // Both know the same light: the deviation of this bias is about half a percent.
    EXPECT_LT(std::abs(compare(film.irradiance(), rounds.film.irradiance()).bias), 0.02);
  }
}

TEST(Cancelled, AfterTheFirstRoundThePictureShowsWhatIsCovered) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached"), 64, 64, 8);
  int asked = 0;
  job.progress.cancelled = [&] { return ++asked > 1; };
  const Rendered r = render_all(job);
  EXPECT_TRUE(r.build.cancelled);
  EXPECT_TRUE(r.final.cancelled);
  EXPECT_EQ(r.build.rounds, 1u);
  // Nothing goes on as a path after a cancellation; near the lamp direct light is sampled in two ways.
  EXPECT_LT(r.final.rays.path, 64u);

  const ExrFile picture = r.exr();
  const RgbImage color = picture.rgb(""), irradiance = picture.rgb("irradiance");
  const std::vector<float>& alpha = picture.find("A")->values;
  std::uint64_t covered = 0, unknown = 0;
  RayCounts counts;
  for (int y = 0; y < job.height; ++y) {
    EXPECT_EQ(r.film.samples(y), 1);
    for (int x = 0; x < job.width; ++x) {
      Sampler stream = job.sampler(x, y, 0);
      const FirstPoint seen = first_point(job.world, job.camera_ray(x, y, stream), true, stream, counts.camera);
      const std::optional<Place> place = place_of(job, seen);
      if (!place) continue;
      const auto cached =
          r.cache.interpolate({place->position, place->normal, seen.point->bsdf.frame.n}, LeakTest{job.world, counts});
      const std::size_t i = static_cast<std::size_t>(y) * job.width + x;
      EXPECT_EQ(alpha[i], cached ? 1 : 0);
      EXPECT_EQ(irradiance.pixels[i], cached.value_or(Rgb{}));
      if (!cached) {
        EXPECT_EQ(color.pixels[i], Rgb{});
      }
      ++(cached ? covered : unknown);
    }
  }
  EXPECT_GT(covered, 100u);
  EXPECT_GT(unknown, 100u);
  EXPECT_EQ(r.final.uncovered, unknown);
}

TEST(Cancelled, InTheFinalPassTheOtherRowsGetOneSample) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"cached", "path"}) {
    SCOPED_TRACE(name);
    Job job = stage.job(method(name, 0.05), 48, 48, 4);
    job.strata = Strata::about(50);
    RecordCache cache = empty_cache(job);
    if (job.method.caches()) build_in_rounds(job, cache);
    int asked = 0;
    job.progress.cancelled = [&] { return ++asked > 20; };  // 16 bands in the first pass, 4 in the second
    Film film(job.width, job.height);
    const RenderReport report = render(job, job.method.caches() ? &cache : nullptr, film);
    EXPECT_TRUE(report.cancelled);
    for (int y = 0; y < job.height; ++y) EXPECT_EQ(film.samples(y), y < 4 * 3 ? 2 : 1);
    const ExrFile picture = film.exr();
    for (const float alpha : picture.find("A")->values) EXPECT_GE(alpha, 0);
    EXPECT_GT(mean_luminance(film.color()), 0.01);
  }
}

TEST(Cancelled, TheLazyOrderStopsMakingRecords) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("ward1992", 0.05), 48, 48, 4);
  job.strata = Strata::about(50);
  int rows = 0;
  job.progress.cancelled = [&] { return ++rows > 10; };
  RecordCache cache = empty_cache(job);
  Film film(job.width, job.height);
  const LazyReport report = render_lazily(job, cache, film);
  EXPECT_TRUE(report.final.cancelled);
  for (int y = 0; y < job.height; ++y) EXPECT_EQ(film.samples(y), y < 10 ? 4 : 1);
  const std::vector<float> alpha = film.exr().find("A")->values;
  EXPECT_GT(std::count(alpha.begin(), alpha.end(), 0.0f), 100);
}

TEST(Progress, ReportsGrowToOneAndPreviewsComeCoarseToFine) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached", 0.05), 64, 64, 4);
  job.strata = Strata::about(50);
  std::vector<std::pair<std::string, double>> reports;
  std::vector<RgbImage> previews;
  job.progress.report = [&](std::string_view phase, double done) { reports.emplace_back(phase, done); };
  job.progress.preview = [&](const RgbImage& image) { previews.push_back(image); };
  const Rendered r = render_all(job);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    EXPECT_GE(reports[i].second, 0);
    EXPECT_LE(reports[i].second, 1);
    if (i > 0 && reports[i].first == reports[i - 1].first) {
      EXPECT_GE(reports[i].second, reports[i - 1].second);
    }
  }
  EXPECT_EQ(reports.front().first, "build");
  EXPECT_EQ(reports.back(), (std::pair<std::string, double>{"final", 1}));
  ASSERT_GE(previews.size(), 3u);
  for (const RgbImage& image : previews) EXPECT_EQ(image.pixels.size(), 64u * 64);
  const auto blocky = [](const RgbImage& image) { return image.at(0, 0) == image.at(1, 1); };
  EXPECT_TRUE(blocky(previews.front()));
  EXPECT_TRUE(previews.back().pixels == r.film.color().pixels);
}

}  // namespace
}  // namespace isophote::test
