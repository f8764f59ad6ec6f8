#include "in_media/seen_point.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/integrate/in_scattering.h"

namespace isophote::bench {
namespace {

const std::uint64_t stream_of_checks = hash(static_cast<std::uint64_t>(Purpose::test), 0x666f67);

double by_paths(const World& world, const SeenPoint& point, int paths, std::uint64_t key, RayCounts& counts) {
  Rgbd sum;
  for (int i = 0; i < paths; ++i) {
    Sampler sampler(key, static_cast<std::uint32_t>(i));
    sum += Rgbd(scatter(world, point.at, point.direction, 0, sampler, counts).indirect);
  }
  return luminance(sum) / paths;
}

/// As many points; the same for the same stream.
std::vector<SeenPoint> seen_points(const Job& job, std::size_t count, std::uint64_t stream) {
  std::vector<SeenPoint> points;
  for (std::size_t i = 0; points.size() < count && i < 100 * count; ++i) {
    Sampler sampler(stream, static_cast<std::uint32_t>(i));
    const Vec2 at = sampler.next2();
    const Ray ray = job.camera.ray(at.x * static_cast<float>(job.width), at.y * static_cast<float>(job.height),
                                   job.width, job.height);
    Hit hit;
    job.world.rays.intersect(ray, sampler.next_bits(), hit);
    for (const auto& p : job.world.media->sample_points({ray.origin, ray.direction, 0, hit.distance}, 1, sampler))
      points.push_back({p.point, ray.direction, job.world.media->holding(p.point.position),
                        job.pixel_footprint(p.distance), hash(stream, i)});
  }
  return points;
}

}  // namespace

std::vector<SeenPoint> checked_points(const Job& job, std::size_t count) {
  return seen_points(job, count, stream_of_checks);
}
std::vector<SeenPoint> record_points(const Job& job, std::size_t count) {
  return seen_points(job, count, hash(static_cast<std::uint64_t>(Purpose::record), job.seed));
}

std::vector<Truth> path_truths(const Job& job, std::size_t count, int paths) {
  const std::vector<SeenPoint> points = checked_points(job, count);
  std::vector<Truth> truths(points.size());
  for_each(job.parallel, points.size(), 1, [&](std::size_t i, RayCounts& counts) {
    const auto half = [&](int h) { return by_paths(job.world, points[i], paths, hash(points[i].key, h), counts); };
    truths[i] = {half(0), half(1)};
  });
  return truths;
}

void write_truths(const std::string& path, const std::vector<Truth>& truths) {
  AtomicFile file(path);
  for (const Truth& t : truths) file.stream() << fmt::format("{} {}\n", t.first, t.second);
  file.commit();
}

std::vector<Truth> read_truths(const std::string& path) {
  std::ifstream file(path);
  std::vector<Truth> truths;
  for (Truth t; file >> t.first >> t.second;) truths.push_back(t);
  if (truths.empty()) throw UserError(path + ": no truths");
  return truths;
}

void InScatteringErrors::add(double value, const Truth& truth) {
  const auto [first, second] = truth;
  squares_ += (value - first) * (value - second);
  errors_ += std::abs(value - truth.mean()), bias_ += value - truth.mean();
  noise_ += (first - second) * (first - second) / 4;
  truths_ += truth.mean();
  ++points_;
}
double InScatteringErrors::rmse() const { return std::sqrt(std::max(0.0, squares_ * points_)) / truths_; }
double InScatteringErrors::noise() const { return std::sqrt(noise_ * points_) / truths_; }

InScatteringErrors errors_at(const Job& job, const std::vector<SeenPoint>& points, const std::vector<Truth>& truths,
                             const RecordCache& cache) {
  InScatteringErrors errors;
  RayCounts counts;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto cached = cached_in_scattering(job.world, {&cache}, points[i].at, points[i].direction, counts))
      errors.add(luminance(Rgbd(*cached)), truths[i]);
  return errors;
}

}  // namespace isophote::bench
