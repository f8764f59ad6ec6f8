#include "isophote/apps/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "isophote/cache/radiance_cache.h"
#include "isophote/cache/record_file.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/core/error.h"
#include "isophote/integrate/film.h"
#include "isophote/integrate/regress.h"
#include "isophote/integrate/scene_hash.h"
#include "isophote/integrate/solve_records.h"
#include "isophote/load/memory_budget.h"

namespace isophote::app {
namespace {

const Option& option_named(const std::string& name) {
  const auto options = app::options();
  return *std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == name; });
}

bool decides_records(std::string_view setting) { return setting == "error" || setting == "a" || setting == "records"; }
std::string both_decide(const std::string& one, const std::string& other) {
  return fmt::format("{} and {} both decide how many records there are: give one", one, other);
}

/// Refuses pictures that do not fit in memory: the film, and twice as much again for the layers made of it and their
/// encoding.
void check_size(int width, int height) {
  const std::uint64_t bytes =
      3 * sizeof(PixelSample) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  MemoryBudget(physical_memory()).take(bytes, fmt::format("a picture of {} x {} pixels", width, height));
}

std::string glossy_settings(const GlossyMethod& g) {
  if (!g.caches()) return std::string(name_of(g.from));
  return fmt::format("{}, {}, {}, {}, a = {}, {}, by bands {}, contrast {}", name_of(g.from), g.estimator->name,
                     g.metric->name, name_of(g.basis), g.settings.a, describe(g.settings.bounds), g.band_power,
                     g.contrast);
}

std::string media_settings(const VolumeMethod& v) {
  if (!v.caches()) return std::string(name_of(v.from));
  return fmt::format("{}, {}, {}, a = {}, aspect {}, {}, {}", name_of(v.from), v.estimator->name, v.metric->name,
                     v.settings.a, v.settings.aspect, describe(v.settings.bounds),
                     v.logarithmic ? "logarithmic" : "linear");
}

/// What shapes records, for the record file. The view and the seed do not matter: records of another view or seed serve
/// as well.
std::string record_settings(const Job& job) {
  const Method& m = job.method;
  const RadiusBounds& b = m.settings.bounds;
  return fmt::format(
      "estimator={}\nmetric={}\na={}\nmin-pixels={}\nmax-pixels={}\nmin-view={}\nmax-view={}\nmin-radius={}\n"
      "max-radius={}\nbound-gradient={}\nbound-neighbours={}\naspect={}\nextrapolate={}\nweight={}\ngather={}\n"
      "secondary={}\nleak-test={}\nmax-depth={}\nglossy={}\nmedia={}\n",
      m.estimator->name, m.metric->name, m.settings.a, b.min_pixels, b.max_pixels, b.min_view, b.max_view, b.min_length,
      b.max_length, b.gradient, b.neighbours, m.settings.aspect, m.order,
      m.settings.falloff ? static_cast<int>(*m.settings.falloff) : -1,
      m.adaptive ? fmt::format("auto, to {:.2g} of the error", m.noise() / m.error())
                 : fmt::format("{}x{}", job.strata.polar, job.strata.azimuthal),
      name_of(m.secondary), m.leak_test, job.world.max_depth, glossy_settings(m.glossy),
      job.world.media ? media_settings(m.volume) : "none");
}

std::vector<RadianceRecord> radiance_of(const RecordCache& cache) {
  if (!cache.radiance()) return {};
  const auto records = cache.radiance()->records();
  return {records.begin(), records.end()};
}

std::array<std::vector<VolumeRecord>, 2> volumes_of(const RecordCache& cache) {
  std::array<std::vector<VolumeRecord>, 2> all;
  for (const VolumePart part : {VolumePart::surfaces, VolumePart::media})
    if (cache.volumes()) {
      const auto records = cache.volumes()->of(part).records();
      all[static_cast<std::size_t>(part)].assign(records.begin(), records.end());
    }
  return all;
}

}  // namespace

RenderSettings merged_settings(const SceneRequest& request, const std::vector<Setting>& from_file) {
  RenderSettings settings;
  std::string deciding;
  for (const Setting& s : from_file) {
    if (s.table == "method" && decides_records(s.key)) {
      if (!deciding.empty()) throw UserError(fmt::format("{}: {}", s.place, both_decide(deciding, s.key)));
      deciding = s.key;
    }
    apply_setting(settings, s.table, s.key, s.value, s.place);
  }
  for (const auto& [name, value] : request.settings) {
    try {
      option_named(name).apply(settings, value);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--{}: {}", name, error.what()));
    }
  }
  return settings;
}

void check_method(const SceneRequest& request, const RenderSettings& settings, const Method& method) {
  std::string deciding;
  for (const auto& [name, value] : request.settings) {
    if (!method.caches() && option_named(name).caches)
      throw UsageError(fmt::format("method 'path' caches nothing: it takes no --{}", name));
    if (!decides_records(name)) continue;
    if (!deciding.empty()) throw UsageError(both_decide("--" + deciding, "--" + name));
    deciding = name;
  }
  if (settings.records && (settings.lazy || !request.load_cache.empty()))
    throw UsageError("--records builds caches in rounds and from nothing: it takes no --order lazy or --load-cache");
}

Session::Session(const SceneRequest& request)
    : request_(request), threads_(request.threads), display_(request.progress), start_(Clock::now()) {}

void Session::read() {
  display_.show("load", 0);
  loaded_ = load_scene(request_.scene, [this](const std::string& line) {
    display_.clear();
    fmt::print(stderr, "isophote: warning: {}\n", line);
  });
  settings_ = merged_settings(request_, loaded_.settings);
  method_ = chosen_method(settings_);
  check_method(request_, settings_, method_);
}

void Session::prepare() {
  const Camera camera = chosen_camera(settings_, loaded_.scene);
  rays_.emplace(loaded_.scene);
  try {
    emitters_.emplace(loaded_.scene);
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", request_.scene, error.what()));
  }
  if (!loaded_.scene.media.empty()) media_.emplace(loaded_.scene);
  job_.emplace(Job{World{loaded_.scene, *rays_, *emitters_,
                         settings_.max_depth.value_or(std::numeric_limits<int>::max()), media_ ? &*media_ : nullptr},
                   camera});
  Job& job = *job_;
  job.height = settings_.height.value_or(512);
  job.width = settings_.width.value_or(
      std::clamp(static_cast<int>(std::lround(512 * (camera.aspect > 0 ? camera.aspect : 1))), 1, 32768));
  check_size(job.width, job.height);
  job.samples = settings_.samples;
  job.seed = settings_.seed;
  job.method = method_;
  const int rays = settings_.rays.value_or(0);
  job.strata = Strata::about(rays > 0 ? rays : default_rays);
  job.parallel = threads_.parallel_for();
  job.progress.report = [this](std::string_view phase, double done) { display_.show(phase, done); };
  job.progress.cancelled = Interruptible::interrupted;
}

RecordCache Session::starting_cache() {
  RecordCache cache = empty_cache(*job_);
  if (request_.load_cache.empty()) return cache;
  const RecordFile file = read_records(request_.load_cache);
  require_match(request_.load_cache, file, scene_hash(loaded_.scene), record_settings(*job_));
  for (const Record& record : file.records) cache.insert(record);
  if (cache.radiance())
    for (const RadianceRecord& record : file.radiance) cache.radiance()->insert(record);
  for (const VolumePart part : {VolumePart::surfaces, VolumePart::media})
    if (cache.volumes())
      for (const VolumeRecord& record : file.volumes[static_cast<std::size_t>(part)])
        cache.volumes()->of(part).insert(record);
  job_->pilot = file.pilot;
  job_->method.settings.a = file.threshold;
  return cache;
}

BuildReport Session::build(RecordCache& cache) {
  BuildReport report;
  if (settings_.records) {
    Solved solved = build_with_records(*job_, static_cast<std::size_t>(*settings_.records));
    cache = std::move(solved.cache);
    report = std::move(solved.report);
    const auto made = static_cast<double>(cache.records().size()), asked = static_cast<double>(*settings_.records);
    if (!report.cancelled && std::abs(made / asked - 1) > records_tolerance) {
      display_.clear();
      fmt::print(stderr, "isophote: warning: --records {}: the nearest that any threshold gave is {}\n",
                 *settings_.records, cache.records().size());
    }
  } else {
    report = build_in_rounds(*job_, cache);
  }
  job_->pilot = report.pilot;
  job_->method.secondary = report.seeding.chosen;
  return report;
}

std::optional<RecordCache> Session::fitted(const RecordCache& cache, RayCounts& counts) const {
  if (!job_->method.regress) return std::nullopt;
  return regressed(*job_, cache, counts);
}

void Session::save(const RecordCache& cache, const std::string& path) const {
  Job job = *job_;
  if (!settings_.records) job.method = method_;  // as it was asked for: refinement lowers the threshold
  job.method.secondary = method_.secondary;      // not what a pilot chose
  const auto records = cache.records();
  write_records(path, {scene_hash(loaded_.scene),
                       record_settings(job),
                       job.pilot,
                       job_->method.settings.a,
                       {records.begin(), records.end()},
                       job.method.glossy.basis,
                       radiance_of(cache),
                       volumes_of(cache)});
}

}  // namespace isophote::app
