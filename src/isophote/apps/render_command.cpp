#include <fmt/format.h>

#include <algorithm>

#include "isophote/apps/render_request.h"
#include "isophote/apps/session.h"
#include "isophote/apps/statistics.h"
#include "isophote/cache/radiance_cache.h"
#include "isophote/image/png.h"
#include "isophote/integrate/record_maps.h"
#include "isophote/integrate/record_picture.h"
#include "isophote/integrate/refine.h"
#include "isophote/integrate/render.h"

namespace isophote::app {
namespace {

RecordColour record_colour(const RenderRequest& request) {
  return request.record_colour == "error" ? RecordColour::error : RecordColour::radius;
}

/// The legend of a picture in false colours.
void tell_scale(const std::string& file, const std::string& what, const ColourScale& scale) {
  fmt::print("{}: {}, from {:.3g} (violet) to {:.3g} (yellow){}\n", file, what, scale.low, scale.high,
             scale.logarithmic ? ", logarithmic" : "");
}

/// As --slice takes it.
void tell_slice(const std::string& file, const Plane& slice) {
  const Vec3 p = slice.point + Vec3{}, n = slice.normal + Vec3{};  // without the sign of a zero
  fmt::print(
      "{}: media on the slice {:.4g},{:.4g},{:.4g};{:.4g},{:.4g},{:.4g}, rims of multiple scattering, dashed ones of "
      "light from surfaces\n",
      file, p.x, p.y, p.z, n.x, n.y, n.z);
}

/// One run of `isophote render`, step by step.
class Rendering {
 public:
  explicit Rendering(const RenderRequest& request) : request_(request), session_(request) {
    // What the flags say wrongly is said before the scene is read; a scene file may yet complete a combination.
    const RenderSettings flags = merged_settings(request, {});
    if (request.scene.ends_with(".toml")) return;
    const Method method = chosen_method(flags);
    check_method(request, flags, method);
    check_against_method(request, flags, method);
  }

  int run() {
    check_outputs(request_);
    load();
    Film film(job().width, job().height);
    if (job().method.caches())
      render_cached(film);
    else
      final_pass(nullptr, film);
    write(film);
    display_.clear();
    statistics_.print();
    return statistics_.cancelled || statistics_.error.cancelled ? 1 : 0;
  }

 private:
  Job& job() { return session_.job(); }

  void load() {
    session_.read();
    check_scene_is_kept(request_, session_.loaded().files);
    check_against_method(request_, session_.settings(), session_.method());
    check_against_scene(request_, session_.loaded().scene);
    session_.prepare();
    if (!request_.preview.empty())
      job().progress.preview = [this](const RgbImage& image) { write_png(request_.preview, image, exposure(image)); };
    statistics_.time.load = Clock::now() - session_.start();
  }

  void render_cached(Film& film) {
    const Clock begin = Clock::now();
    RecordCache cache = session_.starting_cache();
    if (settings_.lazy) {
      const LazyReport report = render_lazily(job(), cache, film);
      job().pilot = report.pilot;
      statistics_.seeding = report.seeding;
      statistics_.time.build = report.build;
      statistics_.rays += report.build_rays;
      build_rays_ = report.build_rays.total();
      note(report.final, Clock::now() - begin - report.build);
      cache.reindex();
      if (cache.radiance()) cache.radiance()->reindex();
    } else {
      build(cache);
      statistics_.time.build = Clock::now() - begin;
      refine(cache);
      final_pass(&shown(cache), film);
    }
    statistics_.records = cache.records().size();
    for (const Record& record : cache.records()) statistics_.record_rays += record.jet.rays;
    statistics_.record_rays /= std::max(1.0, static_cast<double>(cache.records().size()));
    if (cache.radiance()) statistics_.glossy.emplace().take(job().method.glossy, *cache.radiance());
    if (cache.volumes()) statistics_.media.emplace().take(job().method.volume, *cache.volumes());
    if (!request_.save_cache.empty()) session_.save(cache, request_.save_cache);
    show(shown(cache));
    if (request_.check && !measured_ && !statistics_.cancelled) check(cache);
  }

  /// Pictures of what the cache is like.
  void show(const RecordCache& cache) {
    display_.clear();
    if (const std::string& file = request_.records_picture; !file.empty()) {
      const RecordColour colour = record_colour(request_);
      const auto [picture, scale, slice] = record_picture(job(), cache, colour, wanted_slice(request_));
      write_png(file, picture, 0);
      tell_scale(file,
                 colour == RecordColour::radius ? "radius of footprints, m" : "predicted relative error at the rim",
                 scale);
      if (slice)
        tell_slice(file, *slice);
      else if (request_.slice)
        fmt::print("{}: there is no record in media\n", file);
    }
    if (!wants_maps()) return;
    const Clock begin = Clock::now();
    maps_ = record_maps(job(), cache, statistics_.rays);
    statistics_.time.final += Clock::now() - begin;
    show(request_.error_picture, "predicted relative error", maps_.error, false);
    show(request_.density_picture, "records per square metre", maps_.density, true);
  }
  bool wants_maps() const {
    return !request_.error_picture.empty() || !request_.density_picture.empty() ||
           std::any_of(request_.outputs.begin(), request_.outputs.end(),
                       [](const std::string& file) { return file.ends_with(".exr"); });
  }
  void show(const std::string& file, const std::string& what, const std::vector<float>& values, bool logarithmic) {
    if (file.empty()) return;
    if (!std::any_of(maps_.density.begin(), maps_.density.end(), [](float d) { return d > 0; })) {
      write_png(file, RgbImage(job().width, job().height), 0);
      fmt::print("{}: no record serves in this picture\n", file);
      return;
    }
    const ColourScale scale = colour_scale(values, logarithmic);
    RgbImage picture(job().width, job().height);
    // Where no record serves there is no density, and black in both.
    for (std::size_t i = 0; i < values.size(); ++i)
      if (maps_.density[i] > 0) picture.pixels[i] = scale(values[i]);
    write_png(file, picture, 0);
    tell_scale(file, what, scale);
  }

  void build(RecordCache& cache) { added(session_.build(cache)); }

  /// Works on the cache until it is measured to be as good as was asked, or as often as was allowed.
  void refine(RecordCache& cache) {
    int& turn = statistics_.refinements;
    for (; turn < request_.refine && !statistics_.cancelled; ++turn) {
      check(cache);
      const double asked = settings_.error.value_or(default_error);
      if (!statistics_.error.exceeds(asked)) return;
      const Clock begin = Clock::now();
      job().method.settings.a = refined_threshold(job().method, asked, statistics_.error.mean);
      added(isophote::refine(job(), cache, places_));
      statistics_.time.build += Clock::now() - begin;
    }
  }

  /// Takes account of records that were added to the cache.
  void added(BuildReport report) {
    measured_ = false;
    fitted_.reset();
    job().pilot = report.pilot;
    job().method.secondary = report.seeding.chosen;
    if (statistics_.seeding.gain == 0) statistics_.seeding = report.seeding;
    places_ = std::move(report.places);
    statistics_.rounds += report.rounds;
    statistics_.passes += report.passes;
    statistics_.rays += report.rays;
    build_rays_ += report.rays.total();
    statistics_.cancelled = statistics_.cancelled || report.cancelled;
  }

  /// The records as pictures show them: those of the cache, or what is fitted to them.
  const RecordCache& shown(const RecordCache& cache) {
    if (!fitted_) {
      if (!job().method.regress || statistics_.cancelled) return cache;
      const Clock begin = Clock::now();
      fitted_ = session_.fitted(cache, statistics_.rays);
      statistics_.time.build += Clock::now() - begin;
    }
    return *fitted_;
  }

  void check(const RecordCache& cache) {
    const RecordCache& fitted = shown(cache);
    display_.show("check", 0);
    const Clock begin = Clock::now();
    measured_ = statistics_.checked = true;
    statistics_.error = check_points(job(), fitted, build_rays_ / 5, statistics_.refinements, &cache);
    statistics_.rays += statistics_.error.rays;
    statistics_.time.check += Clock::now() - begin;
  }

  void final_pass(const RecordCache* cache, Film& film) {
    const Clock begin = Clock::now();
    const RenderReport report = isophote::render(job(), cache, film);
    note(report, Clock::now() - begin);
  }

  void note(const RenderReport& report, const Clock& spent) {
    statistics_.time.final = spent;
    statistics_.rays += report.rays;
    statistics_.uncovered = report.uncovered;
    statistics_.cancelled = statistics_.cancelled || report.cancelled;
  }

  float exposure(const RgbImage& image) const {
    return settings_.exposure ? *settings_.exposure : auto_exposure(image);
  }

  void write(const Film& film) {
    display_.clear();
    for (const std::string& output : request_.outputs) {
      if (output.ends_with(".exr")) {
        ExrFile file = film.exr();
        if (job().method.caches()) {
          file.add("error", maps_.error);
          file.add("density", maps_.density);
        }
        write_exr(output, file);
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
    const Job& job = session_.job();
    s.method = job.method.name;
    if (job.method.caches()) {
      s.estimator = job.method.estimator->name;
      s.metric = job.method.metric->name;
      s.a = job.method.settings.a, s.aspect = job.method.settings.aspect;
      s.survey = job.pilot;
      s.extrapolate = std::min(job.method.order, job.method.estimator->order);
      s.bounds = describe(job.method.settings.bounds);
    }
    s.lazy = settings_.lazy, s.secondary = session_.method().secondary, s.strata = job.strata;
    s.adaptive = job.method.adaptive, s.leak_test = job.method.leak_test, s.regress = job.method.regress;
    s.records_asked = settings_.records;
    // Where a threshold or a number of records was given, no error was asked for.
    if (!settings_.a && !settings_.records) s.error_asked = settings_.error.value_or(default_error);
    s.seed = settings_.seed, s.threads = session_.threads();
    s.width = job.width, s.height = job.height, s.triangles = session_.loaded().scene.triangle_count();
    s.samples = film.samples();
    s.time.total = Clock::now() - session_.start();
  }

  const RenderRequest& request_;
  Session session_;
  const RenderSettings& settings_ = session_.settings();
  ProgressDisplay& display_ = session_.display();
  Statistics statistics_;
  RecordMaps maps_;
  std::uint64_t build_rays_ = 0;
  bool measured_ = false;      // the cache as it is now
  std::vector<Place> places_;  // of the records that this run made
  std::optional<RecordCache> fitted_;
};

}  // namespace

int render(const RenderRequest& request) {
  check_request(request);
  return Rendering(request).run();
}

}  // namespace isophote::app
