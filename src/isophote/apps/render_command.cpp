#include <fmt/format.h>

#include <algorithm>

#include "isophote/apps/progress_display.h"
#include "isophote/apps/render_request.h"
#include "isophote/apps/statistics.h"
#include "isophote/apps/threads.h"
#include "isophote/cache/record_file.h"
#include "isophote/core/error.h"
#include "isophote/image/png.h"
#include "isophote/integrate/record_picture.h"
#include "isophote/integrate/render.h"
#include "isophote/integrate/scene_hash.h"
#include "isophote/integrate/solve_records.h"
#include "isophote/load/memory_budget.h"
#include "isophote/load/scene_file.h"

namespace isophote::app {
namespace {

/// Refuses pictures that do not fit in memory: the film, and twice as much again for the layers made of it and their
/// encoding.
void check_size(int width, int height) {
  const std::uint64_t bytes =
      3 * sizeof(PixelSample) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  MemoryBudget(physical_memory()).take(bytes, fmt::format("a picture of {} x {} pixels", width, height));
}

/// What shapes records, for the record file. The view and the seed do not matter: records of another view or seed serve
/// as well.
std::string record_settings(const Job& job) {
  const RadiusBounds& b = job.method.settings.bounds;
  return fmt::format(
      "estimator={}\nmetric={}\na={}\nmin-pixels={}\nmax-pixels={}\nmin-view={}\nmin-radius={}\nmax-radius={}\n"
      "bound-gradient={}\nbound-neighbours={}\naspect={}\nextrapolate={}\nweight={}\ngather={}x{}\nsecondary={}\n"
      "leak-test={}\nmax-depth={}\n",
      job.method.estimator->name, job.method.metric->name, job.method.settings.a, b.min_pixels, b.max_pixels,
      b.min_view, b.min_length, b.max_length, b.gradient, b.neighbours, job.method.settings.aspect, job.method.order,
      job.method.settings.falloff ? static_cast<int>(*job.method.settings.falloff) : -1, job.strata.polar,
      job.strata.azimuthal, job.method.secondary, job.method.leak_test, job.world.max_depth);
}

/// One run of `isophote render`, step by step.
class Rendering {
 public:
  explicit Rendering(const RenderRequest& request)
      : request_(request), threads_(request.threads), display_(request.progress), start_(Clock::now()) {
    // What the flags say wrongly is said before the scene is read; a scene file may yet complete a combination.
    const RenderSettings flags = merged_settings(request, {});
    if (!request.scene.ends_with(".toml")) check_against_method(request, flags, chosen_method(flags));
  }

  int run() {
    check_outputs(request_);
    load();
    Film film(job_->width, job_->height);
    if (job_->method.caches())
      render_cached(film);
    else
      final_pass(nullptr, film);
    write(film);
    display_.clear();
    statistics_.print();
    return statistics_.cancelled ? 1 : 0;
  }

 private:
  void load() {
    display_.show("load", 0);
    loaded_ = load_scene(request_.scene, [this](const std::string& line) {
      display_.clear();
      fmt::print(stderr, "isophote: warning: {}\n", line);
    });
    check_scene_is_kept(request_, loaded_.files);
    settings_ = merged_settings(request_, loaded_.settings);
    const Method method = chosen_method(settings_);
    check_against_method(request_, settings_, method);
    const Camera camera = chosen_camera(settings_, loaded_.scene);
    rays_.emplace(loaded_.scene);
    try {
      emitters_.emplace(loaded_.scene);
    } catch (const UserError& error) {
      throw UserError(fmt::format("{}: {}", request_.scene, error.what()));
    }
    job_.emplace(
        Job{World{loaded_.scene, *rays_, *emitters_, settings_.max_depth.value_or(std::numeric_limits<int>::max())},
            camera});
    Job& job = *job_;
    job.height = settings_.height.value_or(512);
    job.width = settings_.width.value_or(
        std::clamp(static_cast<int>(std::lround(512 * (camera.aspect > 0 ? camera.aspect : 1))), 1, 32768));
    check_size(job.width, job.height);
    job.samples = settings_.samples;
    job.seed = settings_.seed;
    job.method = method;
    job.strata = Strata::about(settings_.rays);
    job.parallel = threads_.parallel_for();
    job.progress.report = [this](std::string_view phase, double done) { display_.show(phase, done); };
    job.progress.cancelled = Interruptible::interrupted;
    if (!request_.preview.empty())
      job.progress.preview = [this](const RgbImage& image) { write_png(request_.preview, image, exposure(image)); };
    statistics_.time.load = Clock::now() - start_;
  }

  void render_cached(Film& film) {
    const Clock begin = Clock::now();
    RecordCache cache = starting_cache();
    if (settings_.lazy) {
      const LazyReport report = render_lazily(*job_, cache, film);
      statistics_.time.build = report.build;
      statistics_.rays += report.build_rays;
      build_rays_ = report.build_rays.total();
      note(report.final, Clock::now() - begin - report.build);
      cache.reindex();
    } else {
      build(cache);
      statistics_.time.build = Clock::now() - begin;
      final_pass(&cache, film);
    }
    statistics_.records = cache.records().size();
    if (!request_.save_cache.empty()) save(cache);
    if (!request_.records_picture.empty()) write_png(request_.records_picture, record_picture(*job_, cache), 0);
    if (request_.check && !statistics_.cancelled) check(cache);
  }

  RecordCache starting_cache() {
    RecordCache cache = empty_cache(*job_);
    if (request_.load_cache.empty()) return cache;
    const RecordFile file = read_records(request_.load_cache);
    require_match(request_.load_cache, file, scene_hash(loaded_.scene), record_settings(*job_));
    for (const Record& record : file.records) cache.insert(record);
    return cache;
  }

  void build(RecordCache& cache) {
    BuildReport report;
    if (settings_.records) {
      Solved solved = build_with_records(*job_, static_cast<std::size_t>(*settings_.records));
      cache = std::move(solved.cache);
      report = solved.report;
    } else {
      report = build_in_rounds(*job_, cache);
    }
    statistics_.rounds = report.rounds;
    statistics_.passes = report.passes;
    statistics_.rays += report.rays;
    build_rays_ = report.rays.total();
    statistics_.cancelled = report.cancelled;
  }

  void check(const RecordCache& cache) {
    display_.show("check", 0);
    const Clock begin = Clock::now();
    statistics_.error = check_points(*job_, cache, build_rays_ / 5);
    statistics_.cancelled = Interruptible::interrupted();
    statistics_.rays += statistics_.error.rays;
    statistics_.time.check = Clock::now() - begin;
  }

  void final_pass(const RecordCache* cache, Film& film) {
    const Clock begin = Clock::now();
    const RenderReport report = isophote::render(*job_, cache, film);
    note(report, Clock::now() - begin);
  }

  void note(const RenderReport& report, const Clock& spent) {
    statistics_.time.final = spent;
    statistics_.rays += report.rays;
    statistics_.uncovered = report.uncovered;
    statistics_.cancelled = statistics_.cancelled || report.cancelled;
  }

  void save(const RecordCache& cache) {
    const auto records = cache.records();
    write_records(request_.save_cache,
                  {scene_hash(loaded_.scene), record_settings(*job_), {records.begin(), records.end()}});
  }

  float exposure(const RgbImage& image) const {
    return settings_.exposure ? *settings_.exposure : auto_exposure(image);
  }

  void write(const Film& film) {
    display_.clear();
    for (const std::string& output : request_.outputs) {
      if (output.ends_with(".exr")) {
        write_exr(output, film.exr());
        continue;
      }
      const RgbImage image = film.color();
      const float stops = exposure(image);
      write_png(output, image, stops);
      fmt::print("{}: exposure {:+.2f} EV\n", output, stops);
    }
    fill_statistics(film);
    if (!request_.stats.empty()) statistics_.write_json(request_.stats);
  }

  void fill_statistics(const Film& film) {
    Statistics& s = statistics_;
    const Job& job = *job_;
    s.method = job.method.name;
    if (job.method.caches()) {
      s.estimator = job.method.estimator->name;
      s.metric = job.method.metric->name;
      s.a = job.method.settings.a;
      s.extrapolate = std::min(job.method.order, job.method.estimator->order);
      s.bounds = describe(job.method.settings.bounds);
    }
    s.lazy = settings_.lazy, s.secondary = job.method.secondary, s.leak_test = job.method.leak_test,
    s.strata = job.strata;
    // Where a threshold or a number of records was given, no error was asked for.
    if (!settings_.a && !settings_.records) s.error_asked = settings_.error.value_or(default_error);
    s.seed = settings_.seed, s.threads = threads_.count();
    s.width = job.width, s.height = job.height, s.triangles = loaded_.scene.triangle_count();
    s.samples = film.samples();
    s.time.total = Clock::now() - start_;
  }

  const RenderRequest& request_;
  Threads threads_;
  Interruptible interruptible_;
  ProgressDisplay display_;
  Clock start_;
  RenderSettings settings_;
  LoadedScene loaded_;
  std::optional<RayCaster> rays_;
  std::optional<Emitters> emitters_;
  std::optional<Job> job_;
  Statistics statistics_;
  std::uint64_t build_rays_ = 0;
};

}  // namespace

int render(const RenderRequest& request) {
  check_request(request);
  return Rendering(request).run();
}

}  // namespace isophote::app
