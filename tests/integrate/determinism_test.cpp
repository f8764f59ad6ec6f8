#include <gtest/gtest.h>

#include "integrate/stage.h"

namespace isophote::test {
namespace {

struct Picture {
  std::string exr, records;
  std::uint64_t uncovered = 0, rays = 0;
};

Picture picture(Job job, ParallelFor parallel) {
  job.parallel = std::move(parallel);
  const Rendered r = render_all(job);
  EXPECT_EQ(r.cache.records().empty(), !job.method.caches());
  RayCounts rays = r.build.rays;
  rays += r.final.rays;
  return {exr_bytes(r.exr()), record_bytes(r.cache), r.final.uncovered, rays.total()};
}

void expect_same(const Picture& a, const Picture& b) {
  EXPECT_TRUE(a.exr == b.exr) << "pictures differ";
  EXPECT_TRUE(a.records == b.records) << "records differ";
  EXPECT_EQ(a.uncovered, b.uncovered);
  EXPECT_EQ(a.rays, b.rays);
}

/// The loop backwards, piece by piece: another order than any that threads are likely to take.
ParallelFor backwards() {
  return [](std::size_t count, std::size_t, const std::function<void(std::size_t, std::size_t)>& body) {
    for (std::size_t i = count; i-- > 0;) body(i, i + 1);
  };
}

void expect_deterministic(const Stage& stage, const char* name, int size) {
  SCOPED_TRACE(name);
  Job job = stage.job(method(name, 0.05), size, size, 2);
  job.strata = Strata::about(200);
  const Picture serial = picture(job, thread_for(1));
  expect_same(picture(job, thread_for(2)), serial);
  expect_same(picture(job, thread_for(8)), serial);
  expect_same(picture(job, thread_for(8)), serial);
  expect_same(picture(job, backwards()), serial);
}

TEST(Determinism, ThreadsAndRunsDoNotChangeTheCornellBox) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"cached", "ward1992", "swept", "path"}) expect_deterministic(stage, name, 80);
}

TEST(Determinism, ThreadsAndRunsDoNotChangeTheAtrium) {
  const Stage stage("atrium.glb");
  for (const char* name : {"cached", "ward1992", "path"}) expect_deterministic(stage, name, 48);
}

TEST(Determinism, TheSeedDoesChangeThem) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached", 0.05), 48, 48, 1);
  job.strata = Strata::about(100);
  const Picture first = picture(job, thread_for(2));
  job.seed = 1;
  const Picture second = picture(job, thread_for(2));
  EXPECT_NE(first.exr, second.exr);
  EXPECT_NE(first.records, second.records);
}

}  // namespace
}  // namespace isophote::test
