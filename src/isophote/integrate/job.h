#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "isophote/cache/catalogue.h"
#include "isophote/core/parallel.h"
#include "isophote/scene/camera.h"
#include "isophote/trace/path.h"

namespace isophote {

/// How a host follows long work; all members may be empty. They are called from one thread at a time.
struct Progress {
  std::function<void(std::string_view phase, double done)> report;  ///< done in [0, 1]
  std::function<bool()> cancelled;                                  ///< asked between pieces of work
  std::function<void(const RgbImage&)> preview;                     ///< a picture so far, coarse at first

  void tell(std::string_view phase, double done) const {
    if (report) report(phase, done);
  }
  bool stop() const { return cancelled && cancelled(); }
};

class JetMemo;
class RecordCache;

/// One picture to compute: what it shows, by which method, and on whose threads. Results depend on everything but
/// `parallel`.
struct Job {
  World world;
  Camera camera{};
  int width = 512, height = 512;
  int samples = 16;  ///< a pixel
  std::uint64_t seed = 0;
  Method method{};
  Strata strata = Strata::about(800);  ///< of each record's gather, unless the method adapts them
  Pilot pilot{};                       ///< of a survey; empty: made before the first record, where one is wanted
  JetMemo* memo = nullptr;             ///< where builds share what their places see; not with secondary caching
  const RecordCache* light =
      nullptr;  ///< what records' gathers read where they hit, unless they read the records so far
  ParallelFor parallel{};
  Progress progress{};

  /// The stream of one sample of one pixel; the same in every pass over it, so that all meet the same first point.
  Sampler sampler(int x, int y, int sample) const {
    const auto pixel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
    return {Purpose::camera, seed, pixel, static_cast<std::uint32_t>(sample)};
  }
  Ray camera_ray(int x, int y, Sampler& stream) const {
    const Vec2 at = stream.next2();
    return camera.ray(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y, width, height);
  }
  /// The length a pixel spans after `path_length` from the eye.
  float pixel_footprint(float path_length) const { return camera.pixel_angle(height) * path_length; }
};

/// Runs body(i, counts) for i in [0, count) on the job's threads, each worker flushing denormals, and returns the rays
/// of all.
RayCounts for_each(const ParallelFor& parallel, std::size_t count, std::size_t grain,
                   const std::function<void(std::size_t, RayCounts&)>& body);

/// CPU seconds of the whole process, and seconds of a steady clock.
struct Clock {
  double cpu = 0, wall = 0;
  static Clock now();
  Clock operator-(const Clock& o) const { return {cpu - o.cpu, wall - o.wall}; }
  Clock& operator+=(const Clock& o) { return cpu += o.cpu, wall += o.wall, *this; }
};

}  // namespace isophote
