#include "isophote/integrate/make_record.h"

#include <gtest/gtest.h>

#include <optional>

#include "integrate/stage.h"

namespace isophote::test {
namespace {

TEST(JetAt, GathersReadTheJobsLightUnlessTheyReadTheRecordsSoFar) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("ward1992"), 32, 32, 1);
  job.strata = Strata::about(100);
  const RecordCache light = render_all(job).cache;
  RayCounts counts;
  std::optional<SeenPlace> seen;
  for (std::uint32_t i = 0; !seen; ++i) {
    Sampler stream(Purpose::test, 0, 0, i);
    seen = random_place(job, stream, 7, counts);
  }
  HemisphereGather scratch;
  const auto by = [&](const RecordCache* cache) {
    gather_hemisphere(job.world, cache, seen->place, job.strata, hash(static_cast<std::uint64_t>(Purpose::record), 7),
                      scratch, counts);
    return job.method.estimator->estimate(scratch).value;
  };
  const auto jet = [&](const RecordCache* so_far) {
    return jet_at(job, so_far, seen->place, job.strata, scratch, counts).value;
  };
  EXPECT_NE(by(&light), by(nullptr));
  EXPECT_EQ(jet(&light), by(nullptr));  // the method follows paths
  job.light = &light;
  EXPECT_EQ(jet(nullptr), by(&light));
  job.method.secondary = true;
  EXPECT_EQ(jet(nullptr), by(nullptr));  // there is no record yet
  job.light = nullptr;
  EXPECT_EQ(jet(&light), by(&light));
}

}  // namespace
}  // namespace isophote::test
