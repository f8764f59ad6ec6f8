#include "isophote/integrate/make_record.h"

#include <gtest/gtest.h>

#include <optional>

#include "integrate/stage.h"

namespace isophote::test {
namespace {

TEST(JetAt, GathersReadWhatTheMethodSays) {
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
  const auto by = [&](const FarLight& from) {
    gather_hemisphere(job.world, from, seen->place, job.strata, hash(static_cast<std::uint64_t>(Purpose::record), 7),
                      scratch, counts);
    return job.method.estimator->estimate(scratch).value;
  };
  IrradianceCells left;
  const auto jet = [&](const RecordCache& so_far) {
    left = {};
    return jet_at(job, so_far, seen->place, job.strata, scratch, left, counts).value;
  };
  const RecordCache none = empty_cache(job);
  EXPECT_NE(by({&light}), by({}));
  EXPECT_EQ(jet(light), by({}));  // the method follows paths
  EXPECT_TRUE(left.cells().empty());
  job.light = &light;
  EXPECT_EQ(jet(none), by({&light}));
  job.light = nullptr;
  job.method.secondary = Secondary::cells;
  IrradianceCells other;
  EXPECT_EQ(jet(light), by({nullptr, &none.cells(), &other}));  // of records it knows nothing
  EXPECT_FALSE(left.cells().empty());
  job.method.secondary = Secondary::records;
  other = {};
  EXPECT_EQ(jet(light), by({&light, &light.cells(), &other}));
}

}  // namespace
}  // namespace isophote::test
