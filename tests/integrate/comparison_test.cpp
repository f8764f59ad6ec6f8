#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "integrate/stage.h"
#include "isophote/integrate/gather.h"
#include "isophote/integrate/jet_memo.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/solve_records.h"

// The order in which the field's methods come out at equal numbers of records. How far apart they are is for the
// benches.
namespace isophote::test {
namespace {

/// A visible place and two independent estimates of its irradiance (luminance).
struct Reference {
  Place place;
  double first, second;
};

std::vector<Reference> references(const Job& job, std::size_t count) {
  std::vector<Reference> all(count);
  for_each(job.parallel, count, 1, [&](std::size_t i, RayCounts& counts) {
    HemisphereGather gather;
    const auto irradiance = [&](std::uint64_t half) {
      const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::test), i, half);
      gather_hemisphere(job.world, {}, all[i].place, Strata::about(1600), key, gather, counts);
      Rgbd sum;
      for (const GatherSample& s : gather.samples) sum += Rgbd(s.radiance);
      return luminance(sum) * M_PI / gather.strata.size();
    };
    std::optional<SeenPlace> seen;
    for (std::uint32_t next = 0; !seen; ++next) {
      Sampler stream(Purpose::test, 0, i, next);
      seen = random_place(job, stream, 0, counts);
    }
    all[i].place = seen->place;
    all[i].first = irradiance(1), all[i].second = irradiance(2);
  });
  return all;
}

/// Root of the mean squared error, in which the references' noise cancels.
double rmse(const RecordCache& cache, const std::vector<Reference>& points) {
  double sum = 0, count = 0;
  for (const Reference& p : points) {
    const auto cached = cache.interpolate({p.place.position, p.place.normal, p.place.normal});
    if (!cached) continue;
    const double value = luminance(Rgbd(*cached));
    sum += (value - p.first) * (value - p.second), ++count;
  }
  EXPECT_GT(count, 0.98 * static_cast<double>(points.size()));
  return std::sqrt(std::max(0.0, sum / count));
}

TEST(Comparison, HessiansBeatTheSplitSphereAndSweptEdgesAreNotBehind) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("swept"), 128, 128, 4);
  job.world.max_depth = 2;  // light that the walls return once: cheap, and as hard to interpolate
  job.strata = Strata::about(500);
  JetMemo memo({find_method("ward1992").estimator, find_method("schwarzhaupt2012").estimator, job.method.estimator});
  job.memo = &memo;
  const std::vector<Reference> points = references(job, 200);
  std::map<std::string, double> error;
  for (const char* name : {"ward1992", "schwarzhaupt2012", "swept"}) {
    job.method = method(name);
    const Solved solved = build_with_records(job, 300);
    EXPECT_NEAR(static_cast<double>(solved.cache.records().size()), 300, 15) << name;
    error[name] = rmse(solved.cache, points);
    std::printf("%s: rmse %.4f with %zu records\n", name, error[name], solved.cache.records().size());
  }
  EXPECT_LT(error["schwarzhaupt2012"], error["ward1992"]);
  EXPECT_LT(error["swept"], error["ward1992"]);
  constexpr double placement_noise = 1.14;
  EXPECT_LT(error["swept"], placement_noise * error["schwarzhaupt2012"]);
}

}  // namespace
}  // namespace isophote::test
