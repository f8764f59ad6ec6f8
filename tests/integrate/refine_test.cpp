#include "isophote/integrate/refine.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/integrate/check_points.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

struct Refined {
  RecordCache first, second;
  BuildReport report;
  MeasuredError before, after;
};

Refined refine_once(const Stage& stage, int threads) {
  Job job = stage.job(method("cached", 0.1), 48, 48, 1);
  job.method.adaptive = true;
  job.method.regress = false;                      // so that the records' own noise shows
  job.method.settings.bounds.max_view = infinity;  // and the threshold decides how far they reach
  job.parallel = thread_for(threads);
  Refined r{empty_cache(job), empty_cache(job), {}, {}, {}};
  const BuildReport built = build_in_rounds(job, r.first);
  job.pilot = built.pilot;
  r.before = check_points(job, r.first, 4000000);
  r.second = r.first;
  job.method.settings.a = refined_threshold(job.method, 0.1, 0.4);
  r.report = refine(job, r.second, built.places);
  r.after = check_points(job, r.second, 4000000, 1);
  return r;
}

TEST(Refine, LowersTheErrorAndKeepsThePlaces) {
  const Stage stage("cornell-box.glb");
  const Refined r = refine_once(stage, 2);
  const auto first = r.first.records(), second = r.second.records();
  ASSERT_GT(second.size(), first.size());
  EXPECT_EQ(r.report.places.size(), second.size());
  std::size_t anew = 0;
  double radii_before = 0, radii_after = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].position, second[i].position);
    EXPECT_GE(second[i].jet.rays, first[i].jet.rays);
    radii_before += first[i].footprint.radius, radii_after += second[i].footprint.radius;
    anew += second[i].jet.value != first[i].jet.value;
  }
  EXPECT_LT(radii_after, radii_before);
  EXPECT_GT(anew, first.size() / 2);
  EXPECT_LT(r.after.mean, 0.7 * r.before.mean);
}

TEST(Refine, DoesNotDependOnThreads) {
  const Stage stage("cornell-box.glb");
  const Refined one = refine_once(stage, 1), many = refine_once(stage, 8);
  ASSERT_EQ(one.second.records().size(), many.second.records().size());
  for (std::size_t i = 0; i < one.second.records().size(); ++i)
    EXPECT_EQ(one.second.records()[i].jet.value, many.second.records()[i].jet.value);
}

TEST(Refine, TheThresholdFollowsTheMeasuredError) {
  const Method m = method("cached", 0.1);
  EXPECT_NEAR(refined_threshold(m, 0.1, 0.2), 0.45f * m.settings.a, 1e-6);
  EXPECT_NEAR(refined_threshold(m, 0.02, 0.04), 0.45f * m.settings.a, 1e-6);  // of what is asked, not of the last turn
  EXPECT_NEAR(refined_threshold(m, 0.1, 10), 0.25f * m.settings.a, 1e-6);
}

}  // namespace
}  // namespace isophote::test
