#include "comparison/fixed_points.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/integrate/build.h"
#include "isophote/integrate/gather.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"

namespace isophote::bench {
namespace {

const std::uint64_t stream_of_points = hash(static_cast<std::uint64_t>(Purpose::test), 0x706f696e7473);

double irradiance(const Job& job, const Place& place, int rays, std::uint64_t key, RayCounts& counts) {
  thread_local HemisphereGather gather;
  gather_hemisphere(job.world, {job.light}, place, Strata::about(rays), key, gather, counts);
  Rgbd sum;
  for (const GatherSample& s : gather.samples) sum += Rgbd(s.radiance);
  return luminance(sum) * std::numbers::pi / gather.strata.size();
}

}  // namespace

std::vector<FixedPoint> make_points(const Job& job, std::size_t count, int rays) {
  std::vector<Place> places;
  RayCounts counts;
  for (std::size_t index = 0; places.size() < count && index < 100 * count; ++index) {
    Sampler stream(stream_of_points, static_cast<std::uint32_t>(index));
    if (const auto seen = random_place(job, stream, 0, counts)) places.push_back(seen->place);
  }
  std::vector<FixedPoint> points(places.size());
  for_each(job.parallel, places.size(), 1, [&](std::size_t i, RayCounts& each) {
    const auto half = [&](int h) { return irradiance(job, places[i], rays, hash(stream_of_points, i, h), each); };
    points[i] = {places[i].position, places[i].normal, half(0), half(1)};
  });
  return points;
}

void write_points(const std::string& path, const std::vector<FixedPoint>& points) {
  AtomicFile file(path);
  for (const FixedPoint& p : points)
    file.stream() << fmt::format("{} {} {} {} {} {} {} {}\n", p.position.x, p.position.y, p.position.z, p.normal.x,
                                 p.normal.y, p.normal.z, p.first, p.second);
  file.commit();
}

std::vector<FixedPoint> read_points(const std::string& path) {
  std::ifstream file(path);
  std::vector<FixedPoint> points;
  for (FixedPoint p; file >> p.position.x >> p.position.y >> p.position.z >> p.normal.x >> p.normal.y >> p.normal.z >>
                     p.first >> p.second;)
    points.push_back(p);
  if (points.empty()) throw UserError(path + ": no fixed points");
  return points;
}

PointErrors point_errors(const World& world, const std::vector<FixedPoint>& points, const RecordCache& cache) {
  PointErrors errors;
  RayCounts counts;
  double squares = 0, noise = 0, reference = 0;
  for (const FixedPoint& p : points) {
    const auto cached = cache.interpolate({p.position, p.normal, p.normal}, LeakTest{world, counts});
    if (!cached) {
      ++errors.uncovered;
      continue;
    }
    ++errors.points;
    const double value = luminance(Rgbd(*cached)), truth = (p.first + p.second) / 2;
    squares += (value - p.first) * (value - p.second);
    noise += (p.first - p.second) * (p.first - p.second) / 4;
    errors.bias += value - truth;
    errors.mean += std::abs(value - truth);
    reference += truth;
  }
  const auto count = static_cast<double>(errors.points);
  errors.rmse = std::sqrt(std::max(0.0, squares * count)) / reference;
  errors.noise = std::sqrt(noise * count) / reference;
  errors.bias /= reference, errors.mean /= reference;
  return errors;
}

}  // namespace isophote::bench
