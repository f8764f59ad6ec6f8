#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "image/test_files.h"
#include "isophote/cache/record_file.h"
#include "isophote/image/metrics.h"
#include "isophote/integrate/build.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/regress.h"
#include "isophote/integrate/render.h"
#include "isophote/load/scene_file.h"

namespace isophote::test {

/// A method as `--method NAME --error E` gives it.
inline Method method(const std::string& name, double error = 0.02) {
  Method m = find_method(name);
  if (m.caches()) m.settings.a = threshold(*m.metric, error);
  if (m.glossy.caches()) m.glossy.settings.a = threshold(*m.glossy.metric, error);
  if (m.volume.caches()) m.volume.settings.a = threshold(*m.volume.metric, error);
  m.adaptive = false;  // a test says itself how many rays there are
  return m;
}

/// A scene with all that rendering it takes.
class Stage {
 public:
  explicit Stage(Scene scene) : scene_(std::move(scene)), rays_(scene_), emitters_(scene_), media_(scene_) {}
  /// One of the project's own scenes.
  explicit Stage(const std::string& file)
      : Stage(load_scene(std::string(ISOPHOTE_SOURCE_DIR) + "/scenes/" + file, [](const std::string& warning) {
                ADD_FAILURE() << warning;
              }).scene) {}
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const Scene& scene() const { return scene_; }
  World world() const {
    return {scene_, rays_, emitters_, std::numeric_limits<int>::max(), scene_.media.empty() ? nullptr : &media_};
  }

  /// On two threads; `camera` is a name, or empty for the first.
  Job job(const Method& how, int width, int height, int samples, const std::string& camera = "") const {
    Job job{world()};
    job.camera = scene_.cameras.at(0);
    for (const Camera& c : scene_.cameras)
      if (c.name == camera) job.camera = c;
    EXPECT_TRUE(camera.empty() || job.camera.name == camera) << "no camera '" << camera << "'";
    job.width = width, job.height = height, job.samples = samples;
    job.method = how;
    job.parallel = thread_for(2);
    return job;
  }

 private:
  Scene scene_;
  RayCaster rays_;
  Emitters emitters_;
  Media media_;
};

struct Rendered {
  Film film;
  RecordCache cache, shown;  ///< as built; as the picture reads it
  BuildReport build;
  RenderReport final;

  ExrFile exr() const { return film.exr(); }
  RgbImage layer(const std::string& name) const { return exr().rgb(name); }
};

inline Rendered render_all(const Job& job) {
  Rendered r{Film(job.width, job.height), empty_cache(job), empty_cache(job), {}, {}};
  if (job.method.caches()) r.build = build_in_rounds(job, r.cache);
  r.shown = job.method.regress && !r.build.cancelled ? regressed(job, r.cache, r.build.rays) : r.cache;
  r.final = render(job, job.method.caches() ? &r.shown : nullptr, r.film);
  return r;
}

/// What a record file holds: every field of every record, in order.
inline std::string record_bytes(const RecordCache& cache) {
  const std::string path = testing_files::temporary("records");
  write_records(path, {0, "", {}, 1, {cache.records().begin(), cache.records().end()}});
  return testing_files::bytes_of(path);
}

inline std::string exr_bytes(const ExrFile& file) {
  const std::string path = testing_files::temporary("picture.exr");
  write_exr(path, file);
  return testing_files::bytes_of(path);
}

/// Mean luminance over the pixels for which `use` holds; all by default.
template <class Use>
double mean_luminance(const RgbImage& image, const Use& use) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (use(i)) sum += luminance(Rgbd(image.pixels[i])), ++count;
  return sum / count;
}
inline double mean_luminance(const RgbImage& image) {
  return mean_luminance(image, [](std::size_t) { return true; });
}

/// The value under which the part `p` of the numbers lies.
inline double percentile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(p * static_cast<double>(values.size())))];
}

/// |a - b| / (b + 0.01 mean b) of luminance, block by block, after averaging over n x n pixels.
inline std::vector<double> block_errors(const RgbImage& image, const RgbImage& reference, int n) {
  const RgbImage a = block_average(image, n), b = block_average(reference, n);
  const double floor = 0.01 * mean_luminance(b);
  std::vector<double> errors;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double truth = luminance(Rgbd(b.pixels[i]));
    errors.push_back(std::abs(luminance(Rgbd(a.pixels[i])) - truth) / (truth + floor));
  }
  return errors;
}

}  // namespace isophote::test
