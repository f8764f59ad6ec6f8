#include "in_media/media_records.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "in_media/placing.h"
#include "isophote/core/error.h"
#include "isophote/image/exr.h"
#include "isophote/image/false_colour.h"
#include "isophote/image/png.h"
#include "isophote/integrate/in_scattering.h"

namespace isophote::bench {
namespace {

struct Variant {
  std::string_view name, method;
  std::string_view estimator{};  ///< another than the method's
  float aspect = 0;              ///< likewise
  bool absolute = false;         ///< is the same total error allowed everywhere, or in proportion to the light?
};
constexpr Variant variants[] = {{"values", "jarosz2008a", "volume"},
                                {"unaware", "jarosz2008a"},
                                {"walls", "cached"},
                                {"balls", "marco2018", {}, 1},
                                {"ellipsoids", "marco2018"},
                                {"balls-absolute", "marco2018", {}, 1, true},
                                {"ellipsoids-absolute", "marco2018", {}, 0, true}};

Method method_of(const Variant& variant) {
  Method method = find_method(variant.method);
  if (!variant.estimator.empty()) method.volume.estimator = &find_volume_estimator(variant.estimator);
  if (variant.aspect > 0) method.volume.settings.aspect = variant.aspect;
  check_combination(method);
  return method;
}

/// Leaves the threshold in the job. What gives many more is given up early, for it would cost gathers.
RecordCache with_records(Job& job, Places& places, std::size_t wanted) {
  constexpr double tolerance = 0.02;
  constexpr int most_tries = 14;
  const std::size_t most = wanted * 5 / 4;
  double low = std::log(0.05), high = std::log(20.0), least_miss = infinity;
  std::optional<RecordCache> best;
  for (int i = 0; i < most_tries && least_miss > tolerance; ++i) {
    job.method.volume.settings.a = static_cast<float>(std::exp((low + high) / 2));
    std::optional<RecordCache> cache = place_records(job, places, most);
    const std::size_t count = cache ? count_records(*cache->volumes()) : most;
    (count > wanted ? low : high) = (low + high) / 2;
    const double miss = std::abs(std::log(static_cast<double>(count) / static_cast<double>(wanted)));
    if (cache && miss < least_miss) best = std::move(cache), least_miss = miss;
  }
  if (!best) throw UserError("no threshold gives so few records in media");
  return std::move(*best);
}

/// Per pixel, the mean over its samples of what at(point, direction, stream, counts) scatters towards the eye.
template <class At>
RgbImage in_scattered(const Job& job, const At& at) {
  RgbImage picture(job.width, job.height);
  for_each(job.parallel, static_cast<std::size_t>(job.height), 1, [&](std::size_t row, RayCounts& counts) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < job.width; ++x) {
      for (int s = 0; s < job.samples; ++s) {
        Sampler stream = job.sampler(x, y, s);
        const Ray ray = job.camera_ray(x, y, stream);
        Hit hit;
        job.world.rays.intersect(ray, stream.next_bits(), hit);
        for (const auto& p : job.world.media->sample_points({ray.origin, ray.direction, 0, hit.distance}, 2, stream)) {
          const Rgb passing = job.world.media->transmittance({ray.origin, ray.direction, 0, p.distance}, 0);
          picture.at(x, y) += passing * p.scattering * p.length * at(p.point, ray.direction, stream, counts) /
                              static_cast<float>(job.samples);
        }
      }
    }
  });
  return picture;
}

/// Where no record serves, by a path.
RgbImage in_scattered_by_records(const Job& job, const RecordCache& cache) {
  return in_scattered(job, [&](const MediumPoint& point, const Vec3& direction, Sampler& stream, RayCounts& counts) {
    if (const auto cached = cached_in_scattering(job.world, {&cache}, point, direction, counts)) return *cached;
    return scatter(job.world, point, direction, 0, stream, counts).indirect;
  });
}

/// Each square of 4 x 4 pixels by its mean, for what paths leave of noise.
RgbImage in_squares(const RgbImage& picture) {
  constexpr int side = 4;
  RgbImage out(picture.width, picture.height), sums(picture.width / side + 1, picture.height / side + 1);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sums.at(x / side, y / side) += picture.at(x, y) / (side * side);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) out.at(x, y) = sums.at(x / side, y / side);
  return out;
}

/// How wrong records are where they lie.
InScatteringErrors own_errors(const Job& job, const std::vector<SeenPoint>& points, const std::vector<Truth>& truths,
                              int gathers) {
  constexpr std::size_t count = 200;
  Places places(job, {points.begin(), points.begin() + std::min(count, points.size())}, gathers);
  places.prepare(count);
  InScatteringErrors errors;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PhaseLobe lobe = phase_lobe(points[i].at.g, -points[i].direction, places.bands(i));
    double value = 0;
    for (const VolumePart part : {VolumePart::surfaces, VolumePart::media}) {
      VolumeRecord record;
      record.jet = places.jet(i, volume_estimators().front(), part);
      value += luminance(Rgbd(extrapolate(record, {}, lobe, places.bands(i)).value));
    }
    errors.add(value, truths[i]);
  }
  return errors;
}

void print(std::string_view variant, std::size_t wanted, const InScatteringErrors& e, std::string_view more) {
  fmt::print(
      "{{\"variant\": \"{}\", \"wanted\": {}, \"rmse\": {}, \"mean\": {}, \"bias\": {}, \"noise\": {}, "
      "\"points\": {}{}}}\n",
      variant, wanted, e.rmse(), e.mean(), e.bias(), e.noise(), e.points(), more);
  std::fflush(stdout);
}

void draw(const Job& job, const RecordCache& cache, const RgbImage& paths, const std::string& stem) {
  constexpr float range = 0.3f;
  const RgbImage picture = in_scattered_by_records(job, cache);
  write_png(stem + ".png", picture, auto_exposure(paths));
  write_png(stem + "-error.png", error_picture(in_squares(picture), in_squares(paths), range), 0);
}

}  // namespace

RgbImage in_scattered_by_paths(const Job& job) {
  return in_scattered(job, [&](const MediumPoint& point, const Vec3& direction, Sampler& stream, RayCounts& counts) {
    return scatter(job.world, point, direction, 0, stream, counts).indirect;
  });
}

void compare_media_records(Job job, const std::vector<Truth>& truths, const MediaComparison& comparison) {
  constexpr std::size_t place_count = 8192;
  const std::vector<SeenPoint> points = checked_points(job, truths.size());
  print("none", 0, own_errors(job, points, truths, comparison.gathers), "");
  Places places(job, record_points(job, place_count), comparison.gathers);
  places.prepare(comparison.counts.back());
  RgbImage paths;
  if (!comparison.pictures.empty()) {
    paths = read_exr_layer(comparison.paths, "");
    write_png(comparison.pictures + "/paths.png", paths, auto_exposure(paths));
  }
  for (const Variant& variant : variants) {
    job.method = method_of(variant);
    job.pilot = variant.absolute ? survey_media(places) : Pilot();
    for (const std::size_t wanted : comparison.counts) {
      const RecordCache cache = with_records(job, places, wanted);
      const VolumeCaches& made = *cache.volumes();
      print(variant.name, wanted, errors_at(job, points, truths, cache),
            fmt::format(", \"surfaces\": {}, \"media\": {}, \"a\": {}", made.surfaces.records().size(),
                        made.media.records().size(), job.method.volume.settings.a));
      if (!comparison.pictures.empty())
        draw(job, cache, paths, fmt::format("{}/{}-{}", comparison.pictures, variant.name, wanted));
    }
  }
}

}  // namespace isophote::bench
