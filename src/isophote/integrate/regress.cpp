#include "isophote/integrate/regress.h"

#include <algorithm>
#include <memory>

#include "isophote/cache/radiance_regression.h"
#include "isophote/cache/regression.h"
#include "isophote/integrate/leak_test.h"

namespace isophote {
namespace {

/// The distrust with the least estimated squared error, judged by no more records than it takes.
double best_distrust(const Job& job, const Regression& regression, std::size_t records, RayCounts& counts) {
  constexpr std::size_t most = 512;
  const std::size_t asked = std::min(records, most);
  std::vector<Regression::Risks> each(asked);
  counts += for_each(job.parallel, asked, 16, [&](std::size_t i, RayCounts& mine) {
    each[i] = regression.risks(static_cast<std::uint32_t>(i * records / asked), LeakTest{job.world, mine});
  });
  Regression::Risks sum{};
  for (const Regression::Risks& m : each)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += m[i];
  return Regression::distrusts[static_cast<std::size_t>(std::min_element(sum.begin(), sum.end()) - sum.begin())];
}

// Radii are what they are, here and below; only the limits on extrapolation follow the new values.

std::shared_ptr<RadianceCache> regressed_radiance(const Job& job, const RadianceCache& cache, RayCounts& counts) {
  const RadianceRegression regression(cache);
  std::vector<RadianceRecord> fitted(cache.records().size());
  counts += for_each(job.parallel, fitted.size(), 16, [&](std::size_t i, RayCounts& each) {
    fitted[i] = regression.fitted(static_cast<std::uint32_t>(i), LeakTest{job.world, each});
  });
  Method settled = job.method;
  settled.glossy.settings.bounds.neighbours = 0;
  auto result = std::make_shared<RadianceCache>(cache.bounds(), cache.basis());
  for (RadianceRecord& record : fitted) {
    const std::uint32_t id = result->insert(std::move(record));
    settled.settle(result->settling(), {&id, 1});
  }
  return result;
}

}  // namespace

RecordCache regressed(const Job& job, const RecordCache& cache, RayCounts& counts) {
  const Regression regression(cache);
  std::vector<Record> fitted(cache.records().size());
  const double distrust = best_distrust(job, regression, fitted.size(), counts);
  counts += for_each(job.parallel, fitted.size(), 16, [&](std::size_t i, RayCounts& each) {
    fitted[i] = regression.fitted(static_cast<std::uint32_t>(i), distrust, LeakTest{job.world, each});
  });
  Method settled = job.method;
  settled.settings.bounds.neighbours = 0;
  RecordCache result(cache.bounds());
  for (const Record& record : fitted) {
    const std::uint32_t id = result.insert(record);
    settled.settle(result.settling(), {&id, 1});
  }
  result.reindex();
  if (cache.radiance()) result.set_radiance(regressed_radiance(job, *cache.radiance(), counts));
  result.set_volumes(cache.volumes());
  return result;
}

}  // namespace isophote
