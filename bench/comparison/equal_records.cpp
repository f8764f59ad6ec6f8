#include "comparison/equal_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "comparison/fixed_points.h"
#include "comparison/variant.h"
#include "isophote/image/png.h"
#include "isophote/integrate/jet_memo.h"
#include "isophote/integrate/record_picture.h"
#include "isophote/integrate/solve_records.h"

namespace isophote::bench {
namespace {

std::vector<const Estimator*> estimators_of(const std::vector<std::string>& variants) {
  std::vector<const Estimator*> all;
  for (const std::string& text : variants) {
    const Estimator* estimator = variant(text).estimator;
    if (std::find(all.begin(), all.end(), estimator) == all.end()) all.push_back(estimator);
  }
  return all;
}

/// Bisects with few rays, so that few places outside the wanted caches are given many.
class Sketch {
 public:
  Sketch(const Job& job, const std::vector<const Estimator*>& estimators) : job_(job), memo_(estimators) {
    job_.strata = Strata::about(200);
    job_.memo = &memo_;
  }
  float threshold(const Method& method, std::size_t wanted) {
    job_.method = method;
    build_with_records(job_, wanted);
    return job_.method.settings.a;
  }

 private:
  Job job_;
  JetMemo memo_;
};

}  // namespace

void compare_at_equal_records(Job job, const std::vector<FixedPoint>& points, const Comparison& comparison) {
  const std::vector<const Estimator*> estimators = estimators_of(comparison.variants);
  Sketch sketch(job, estimators);
  JetMemo memo(estimators);
  job.memo = &memo;
  for (const std::string& text : comparison.variants) {
    job.method = variant(text);
    for (const std::size_t wanted : comparison.counts) {
      const Clock begin = Clock::now();
      job.method.settings.a = sketch.threshold(job.method, wanted);
      const Solved solved = build_with_records(job, wanted);
      const PointErrors e = point_errors(job.world, points, solved.cache);
      fmt::print(
          "{{\"variant\": \"{}\", \"wanted\": {}, \"records\": {}, \"a\": {}, \"rmse\": {}, \"mean\": {}, "
          "\"bias\": {}, \"noise\": {}, \"points\": {}, \"uncovered\": {}, \"cpu_seconds\": {}}}\n",
          text, wanted, solved.cache.records().size(), job.method.settings.a, e.rmse, e.mean, e.bias, e.noise, e.points,
          e.uncovered, (Clock::now() - begin).cpu);
      std::fflush(stdout);
      if (!comparison.pictures.empty())
        write_png(fmt::format("{}/{}-{}.png", comparison.pictures, text, wanted),
                  record_picture(job, solved.cache, RecordColour::radius).picture, 0);
    }
  }
}

}  // namespace isophote::bench
