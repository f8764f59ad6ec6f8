#include "isophote/integrate/check_points.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/adaptive_rays.h"
#include "isophote/integrate/gather.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

constexpr int rays_per_point = 3200;       // where records do not adapt theirs
constexpr int fewest = 40, most = 1024;    // of fewer, the 95th percentile would be the largest
constexpr std::size_t between_stops = 64;  // points, after which the host is asked whether to go on

struct CheckPoint {
  bool valid = false;
  double cached = 0, reference = 0, noise = 0;
  Vec2 pixel;
};

/// Rays for a reference whose own error is about half of what a record here would have, and more where records read
/// cached light, which is less noisy than paths.
int reference_rays(const Job& job, const RecordCache& built, const Place& place) {
  if (!job.method.adaptive) return rays_per_point;
  const int finer = job.method.regress ? 10 : 4;  // records that have been fitted are surer than their rays
  return finer * strata_near(job, built, place).size();
}

/// Irradiance (luminance) at a place by a path-traced gather.
double reference(const Job& job, const Place& place, int rays, std::uint64_t key, HemisphereGather& gather,
                 RayCounts& counts) {
  gather_hemisphere(job.world, {}, place, Strata::about(rays), key, gather, counts);
  Rgbd sum;
  for (const GatherSample& s : gather.samples) sum += Rgbd(s.radiance);
  return luminance(sum) * std::numbers::pi / gather.strata.size();
}

/// A random visible point; none where chance finds nothing but sky and mirrors.
std::optional<SeenPlace> random_point(const Job& job, std::uint64_t key, std::size_t index, RayCounts& rays) {
  constexpr int most_tries = 64;
  Sampler stream(key, static_cast<std::uint32_t>(index));
  for (int i = 0; i < most_tries; ++i)
    if (const auto seen = random_place(job, stream, hash(key, index), rays)) return seen;
  return std::nullopt;
}

/// What the cache and a path-traced gather say of a random visible point that the cache covers.
CheckPoint check_point(const Job& job, const RecordCache& cache, const RecordCache& built, int turn, std::size_t index,
                       RayCounts& counts) {
  const std::uint64_t key = hash(static_cast<std::uint64_t>(Purpose::check), job.seed, turn);
  RayCounts rays;
  CheckPoint result;
  if (const std::optional<SeenPlace> seen = random_point(job, key, index, rays)) {
    if (const auto cached = cache.interpolate(query_at(seen->place), LeakTest{job.world, rays})) {
      HemisphereGather scratch;
      const int half = reference_rays(job, built, seen->place) / 2;
      const double a = reference(job, seen->place, half, hash(key, index, 0), scratch, rays);
      const double b = reference(job, seen->place, half, hash(key, index, 1), scratch, rays);
      // Half the difference of two is as wide as their mean's error, whatever strata and paths have in common.
      result = {true, luminance(Rgbd(*cached)), (a + b) / 2, std::abs(a - b) / 2, seen->pixel};
    }
  }
  counts.check += rays.total();
  return result;
}

MeasuredError summary(const std::vector<CheckPoint>& points) {
  MeasuredError error;
  double cached = 0, reference = 0;
  for (const CheckPoint& p : points)
    if (p.valid) ++error.points, cached += p.cached, reference += p.reference;
  if (error.points == 0) return error;
  const double floor = 0.01 * reference / error.points;
  std::vector<double> errors;
  for (const CheckPoint& p : points) {
    if (!p.valid) continue;
    const double scale = p.reference + floor;
    errors.push_back(scale > 0 ? std::abs(p.cached - p.reference) / scale : (p.cached == 0 ? 0.0 : 1.0));
    error.mean += errors.back() / error.points;
    if (errors.back() >= error.largest) {
      error.largest = errors.back();
      error.largest_x = static_cast<int>(p.pixel.x), error.largest_y = static_cast<int>(p.pixel.y);
    }
    error.noise += scale > 0 ? p.noise / scale / error.points : 0;
  }
  std::sort(errors.begin(), errors.end());
  error.median = errors[errors.size() / 2];
  error.p95 = errors[std::min(errors.size() - 1, static_cast<std::size_t>(0.95 * static_cast<double>(errors.size())))];
  error.bias = reference > 0 ? cached / reference - 1 : 0;
  return error;
}

}  // namespace

MeasuredError check_points(const Job& job, const RecordCache& cache, std::uint64_t ray_budget, int turn,
                           const RecordCache* built) {
  std::vector<CheckPoint> points(fewest);
  RayCounts rays;
  std::size_t total = most;  // not known before the first points have been measured
  const auto measure = [&](std::size_t from) {
    for (; from < points.size() && !job.progress.stop(); from += between_stops) {
      rays += for_each(job.parallel, std::min(between_stops, points.size() - from), 1,
                       [&](std::size_t i, RayCounts& counts) {
                         points[from + i] = check_point(job, cache, built ? *built : cache, turn, from + i, counts);
                       });
      const std::size_t done = std::min(points.size(), from + between_stops);
      job.progress.tell("check", static_cast<double>(done) / static_cast<double>(total));
    }
  };
  const auto cancelled = [&] {
    MeasuredError error;
    error.rays = rays, error.cancelled = true;
    return error;
  };
  measure(0);
  if (job.progress.stop()) return cancelled();
  const double each = std::max(1.0, static_cast<double>(rays.check) / fewest);
  const auto wanted = std::clamp(static_cast<double>(ray_budget) / each, double{fewest}, double{most});
  total = static_cast<std::size_t>(wanted);
  points.resize(total);
  measure(fewest);
  if (job.progress.stop()) return cancelled();
  job.progress.tell("check", 1);
  MeasuredError error = summary(points);
  error.rays = rays;
  return error;
}

}  // namespace isophote
