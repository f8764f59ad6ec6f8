#include "isophote/integrate/render.h"

#include <atomic>

#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/march.h"
#include "isophote/integrate/pilot.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

enum class Uncovered { trace, skip };

struct Seen {
  PixelSample sample;
  bool covered = true;
};

/// One sample of a pixel whose camera ray has been followed to `seen`.
Seen shade_sample(const Job& job, const RecordCache* cache, const Ray& ray, const FirstPoint& seen, Uncovered uncovered,
                  Sampler& stream, RayCounts& counts) {
  Seen result;
  PixelSample& out = result.sample;
  out.direct = seen.emission;
  const float distance = seen.first_distance < infinity ? seen.first_distance : seen.path_length;
  if (distance == infinity) {
    out.alpha = 1 - mean(seen.throughput);  // what media took on the way
    return result;
  }
  out.alpha = 1;
  out.depth = distance * dot(ray.direction, job.camera.forward);
  if (seen.medium_point) {
    const Scattered light = scatter(job.world, *seen.medium_point, seen.direction, seen.depth, stream, counts);
    out.direct += seen.throughput * light.direct;
    out.indirect = seen.throughput * light.indirect;
  }
  if (!seen.point) return result;
  const SurfacePoint& point = *seen.point;
  const Vec3 wo = -seen.direction;
  out.albedo = diffuse_albedo(point.bsdf, wo);
  out.normal = point.bsdf.frame.n;
  if (seen.depth >= job.world.max_depth) return result;
  Shaded light;
  if (!cache || seen.depth + 1 >= job.world.max_depth) {
    const Scattered path = scatter(job.world, point, wo, seen.depth, stream, counts);
    light = {path.direct, path.indirect, path.irradiance, true};
  } else if (uncovered == Uncovered::skip && point.bsdf.has_diffuse() &&
             !cache->covers(query_at(point), LeakTest{job.world, counts})) {
    return {{}, false};  // nothing is known here, not even the direct light: alpha 0
  } else {
    light = shade(job.world, {cache, nullptr, nullptr, &job.method.glossy}, point, wo, seen.path_length, seen.depth,
                  stream, counts);
  }
  out.direct += seen.throughput * light.direct;
  out.indirect = seen.throughput * light.indirect;
  out.irradiance = light.irradiance;
  result.covered = light.covered;
  return result;
}

/// One sample of a pixel. Where the cache has records of media, the way to the first surface is marched; further on,
/// and without them, media scatter by chance.
Seen see(const Job& job, const RecordCache* cache, const Ray& ray, Uncovered uncovered, Sampler& stream,
         RayCounts& counts) {
  if (!cache || !cache->volumes() || !job.world.media)
    return shade_sample(job, cache, ray, first_point(job.world, ray, true, stream, counts.camera), uncovered, stream,
                        counts);
  FirstPoint seen = first_point(job.world, ray, true, stream, counts.camera, {}, FirstSegment::clear);
  const Ray way{ray.origin, ray.direction, 0, seen.first_distance};
  const auto where = uncovered == Uncovered::skip ? WhereUncovered::nothing : WhereUncovered::path;
  const Marched marched =
      march(job.world, {cache, nullptr, nullptr, &job.method.glossy}, way, 0, where, stream, counts);
  if (!marched.covered && uncovered == Uncovered::skip) return {{}, false};
  seen.emission *= marched.transmittance, seen.throughput *= marched.transmittance;
  Seen result = shade_sample(job, cache, ray, seen, uncovered, stream, counts);
  result.sample.direct += marched.direct;
  result.sample.indirect += marched.indirect;
  result.sample.irradiance *= marched.transmittance;
  result.covered = result.covered && marched.covered;
  return result;
}

class FinalPass {
 public:
  FinalPass(const Job& job, const RecordCache* cache, Film& film) : job_(job), cache_(cache), film_(film) {}

  RenderReport run() {
    for (int first = 0; first < job_.samples && !report_.cancelled;) {
      const int count = std::min(std::max(first, 1), job_.samples - first);
      pass(first, count);
      first += count;
    }
    if (report_.cancelled) complete();
    report_.uncovered = uncovered_;
    return report_;
  }

 private:
  /// Samples first..first + count - 1 of every pixel, in bands of rows between which the host is heard.
  void pass(int first, int count) {
    const int band = std::max(1, job_.height / 16);
    for (int top = 0; top < job_.height; top += band) {
      if (job_.progress.stop()) {
        report_.cancelled = true;
        return;
      }
      rows(top, std::min(band, job_.height - top), first, count, Uncovered::trace);
      const double here = static_cast<double>(std::min(top + band, job_.height)) / job_.height;
      job_.progress.tell("final", (first + count * here) / job_.samples);
    }
    if (job_.progress.preview) job_.progress.preview(film_.color());
  }

  void rows(int top, int number, int first, int count, Uncovered uncovered) {
    report_.rays += for_each(job_.parallel, static_cast<std::size_t>(number), 1, [&](std::size_t i, RayCounts& counts) {
      const int y = top + static_cast<int>(i);
      std::uint64_t missed = 0;
      for (int x = 0; x < job_.width; ++x)
        for (int s = first; s < first + count; ++s) missed += !sample(x, y, s, uncovered, counts);
      film_.finish_row(y, count);
      uncovered_ += missed;
    });
  }

  bool sample(int x, int y, int s, Uncovered uncovered, RayCounts& counts) {
    Sampler stream = job_.sampler(x, y, s);
    const Ray ray = job_.camera_ray(x, y, stream);
    const Seen result = see(job_, cache_, ray, uncovered, stream, counts);
    film_.add(x, y, result.sample);
    return result.covered;
  }

  /// Rows that have nothing yet get one sample of what is covered.
  void complete() {
    for (int top = 0, end = 0; top < job_.height; top = end + 1) {
      for (end = top; end < job_.height && film_.samples(end) == 0;) ++end;
      if (end > top) rows(top, end - top, 0, 1, Uncovered::skip);
    }
  }

  const Job& job_;
  const RecordCache* cache_;
  Film& film_;
  RenderReport report_;
  std::atomic<std::uint64_t> uncovered_ = 0;
};

}  // namespace

RenderReport render(const Job& job, const RecordCache* cache, Film& film) { return FinalPass(job, cache, film).run(); }

Radiance pixel_radiance(const Job& job, const RecordCache& cache, int x, int y) {
  Radiance sum;
  RayCounts counts;
  for (int s = 0; s < job.samples; ++s) {
    Sampler stream = job.sampler(x, y, s);
    const Ray ray = job.camera_ray(x, y, stream);
    const PixelSample sample = see(job, &cache, ray, Uncovered::trace, stream, counts).sample;
    sum.direct += sample.direct;
    sum.indirect += sample.indirect;
  }
  const auto samples = static_cast<float>(job.samples);
  return {sum.direct / samples, sum.indirect / samples};
}

RgbImage coarse_picture(const Job& job, const RecordCache& cache, int stride) {
  RgbImage picture(job.width, job.height);
  const auto rows = static_cast<std::size_t>((job.height + stride - 1) / stride);
  for_each(job.parallel, rows, 1, [&](std::size_t row, RayCounts& counts) {
    const int top = static_cast<int>(row) * stride;
    for (int left = 0; left < job.width; left += stride) {
      const int x = std::min(left + stride / 2, job.width - 1), y = std::min(top + stride / 2, job.height - 1);
      Sampler stream = job.sampler(x, y, 0);
      const Ray ray = job.camera_ray(x, y, stream);
      const PixelSample s = see(job, &cache, ray, Uncovered::skip, stream, counts).sample;
      for (int v = top; v < std::min(top + stride, job.height); ++v)
        for (int u = left; u < std::min(left + stride, job.width); ++u) picture.at(u, v) = s.direct + s.indirect;
    }
  });
  return picture;
}

LazyReport render_lazily(const Job& asked, RecordCache& cache, Film& film) {
  LazyReport report;
  Job job = asked;
  report.pilot = job.pilot;
  report.seeding = seed_cells(job, cache, report.build_rays);
  job.method.secondary = report.seeding.chosen;
  if (must_survey(job))
    report.pilot = job.pilot = survey(job, cache, random_places(job, report.build_rays), report.build_rays).pilot;
  HemisphereGather scratch;
  const FlushDenormals flush;
  for (int y = 0; y < job.height; ++y) {
    report.final.cancelled = report.final.cancelled || job.progress.stop();
    const int samples = report.final.cancelled ? 1 : job.samples;
    for (int x = 0; x < job.width; ++x) {
      for (int s = 0; s < samples; ++s) {
        Sampler stream = job.sampler(x, y, s);
        const Ray ray = job.camera_ray(x, y, stream);
        const FirstPoint seen = first_point(job.world, ray, true, stream, report.final.rays.camera);
        const std::uint64_t key = hash(job.seed, x, y, s);
        std::optional<Place> place;
        if (!report.final.cancelled) place = uncovered_place(job, cache, seen, key, report.build_rays);
        if (place) {
          const Clock before = Clock::now();
          IrradianceCells left;
          NewRecords made = make_records(job, cache, *place, scratch, left, report.build_rays);
          take_in(job.world, cache.cells(), {&left, 1}, report.build_rays);
          add_records(job.method, cache, {std::move(made)});
          report.build += Clock::now() - before;
        }
        const Uncovered uncovered = report.final.cancelled ? Uncovered::skip : Uncovered::trace;
        const Seen result = shade_sample(job, &cache, ray, seen, uncovered, stream, report.final.rays);
        film.add(x, y, result.sample);
        report.final.uncovered += !result.covered;
      }
    }
    film.finish_row(y, samples);
    job.progress.tell("final", (y + 1.0) / job.height);
  }
  return report;
}

}  // namespace isophote
