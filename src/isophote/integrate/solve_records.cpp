#include "isophote/integrate/solve_records.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "isophote/integrate/jet_memo.h"

namespace isophote {
namespace {

const double least_log_a = std::log(double{least_threshold}), greatest_log_a = std::log(double{greatest_threshold});
constexpr int most_tries = 10;

struct Try {
  double log_a, log_records;
};

/// By which power of the threshold the number of records falls: as between the last two tries, within reason.
double steepness(const std::optional<Try>& last, const Try& now) {
  constexpr double usual = 1.7, least = 0.2, most = 2.5;
  if (!last || last->log_a == now.log_a) return usual;
  return std::clamp((last->log_records - now.log_records) / (now.log_a - last->log_a), least, most);
}

}  // namespace

Solved build_with_records(Job& asked, std::size_t wanted) {
  // Tries differ in where records lie and how far they reach, not in what a place sees, unless that is cached light.
  std::optional<JetMemo> memo;
  Job job = asked;
  if (!job.memo && job.method.secondary == Secondary::off && !job.method.adaptive)
    job.memo = &memo.emplace(std::vector{job.method.estimator});
  std::optional<Try> previous;
  std::optional<Try> above, below;  // the nearest with too many records and with too few
  std::optional<Solved> best;
  double best_miss = 0, log_a = std::log(job.method.settings.a), last_log_a = 0;
  float best_a = job.method.settings.a;
  RayCounts rays;
  const double target = std::log(static_cast<double>(std::max<std::size_t>(wanted, 1)));
  for (int i = 0; i < most_tries; ++i) {
    log_a = std::clamp(log_a, least_log_a, greatest_log_a);
    if (i > 0 && log_a == last_log_a) break;  // no threshold gives as many, or as few
    last_log_a = log_a;
    job.method.settings.a = static_cast<float>(std::exp(log_a));
    Solved attempt{empty_cache(job), {}};
    attempt.report = build_in_rounds(job, attempt.cache);
    rays += attempt.report.rays;
    if (attempt.report.cancelled) {
      best = std::move(attempt), best_a = job.method.settings.a;
      break;
    }
    const double log_records = std::log(static_cast<double>(std::max<std::size_t>(attempt.cache.records().size(), 1)));
    const double miss = std::abs(log_records - target);
    if (!best || miss < best_miss) best = std::move(attempt), best_miss = miss, best_a = job.method.settings.a;
    if (miss < records_tolerance) break;
    (log_records > target ? above : below) = Try{log_a, log_records};
    if (above && below)
      log_a = above->log_a +
              (below->log_a - above->log_a) * (above->log_records - target) / (above->log_records - below->log_records);
    else
      log_a += (log_records - target) / steepness(previous, {log_a, log_records});
    previous = Try{last_log_a, log_records};
  }
  asked.method.settings.a = best_a;
  best->report.rays = rays;
  return std::move(*best);
}

}  // namespace isophote
