#include "isophote/apps/statistics.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "isophote/core/atomic_file.h"

namespace isophote::app {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// What decided where records lie, what they see and how they are used.
Json parameters(const Statistics& s) {
  const Json survey = s.survey.known ? Json{{"irradiance", s.survey.irradiance},
                                            {"error_rate", s.survey.error_rate},
                                            {"noise_rate", s.survey.noise_rate}}
                                     : Json(nullptr);
  return {{"estimator", s.estimator},
          {"metric", s.metric},
          {"a", s.a},
          {"records_asked", or_null(s.records_asked)},
          {"bounds", s.bounds},
          {"extrapolate", s.extrapolate},
          {"aspect", std::isfinite(s.aspect) ? Json(s.aspect) : Json(nullptr)},
          {"survey", survey},
          {"rays_in_the_mean", s.record_rays},
          {"gather", s.adaptive ? Json("auto") : Json{s.strata.polar, s.strata.azimuthal}},
          {"order", s.lazy ? "lazy" : "rounds"},
          {"secondary", name_of(s.seeding.chosen)},
          {"secondary_gain", s.seeding.gain},
          {"leak_test", s.leak_test},
          {"regress", s.regress}};
}

Json glossy_records(const Statistics::GlossyRecords& g) {
  return {{"from", name_of(g.method.from)},
          {"estimator", g.method.estimator->name},
          {"metric", g.method.metric->name},
          {"basis", name_of(g.method.basis)},
          {"a", g.method.settings.a},
          {"records", g.records},
          {"bands_in_the_mean", g.bands},
          {"rays_in_the_mean", g.rays},
          {"bytes", g.bytes}};
}

Json media_records(const Statistics::MediaRecords& m) {
  return {{"from", name_of(m.method.from)},
          {"estimator", m.method.estimator->name},
          {"metric", m.method.metric->name},
          {"a", m.method.settings.a},
          {"records", {{"surfaces", m.surfaces}, {"media", m.media}}},
          {"bytes", m.bytes}};
}

/// What gather rays read where they hit, and why.
std::string describe_secondary(const Statistics& s) {
  std::string text(name_of(s.seeding.chosen));
  if (!(s.seeding.gain > 0)) return text;
  return text + fmt::format("{}: cells make the variance of a gather times its rays {:.2g} times smaller",
                            s.secondary == Secondary::automatic ? ", by a pilot" : "", s.seeding.gain);
}

Json measured(const MeasuredError& error, const std::optional<double>& asked) {
  if (error.points == 0) return {{"asked", or_null(asked)}, {"points", 0}};
  return {{"asked", or_null(asked)},
          {"mean", error.mean},
          {"median", error.median},
          {"p95", error.p95},
          {"largest", {{"error", error.largest}, {"pixel", {error.largest_x, error.largest_y}}}},
          {"bias", error.bias},
          {"noise", error.noise},
          {"points", error.points}};
}

}  // namespace

void Statistics::GlossyRecords::take(const GlossyMethod& by, const RadianceCache& cache) {
  method = by, records = cache.records().size();
  for (const RadianceRecord& r : cache.records()) {
    const auto& [u, v, none] = r.jet.translational;
    bands += RadianceCache::bands(r), rays += r.jet.rays;
    bytes += sizeof(r) + sizeof(Rgb) * (r.jet.value.size() + u.size() + v.size());
  }
  bands /= std::max<double>(1, static_cast<double>(records)), rays /= std::max<double>(1, static_cast<double>(records));
}

void Statistics::MediaRecords::take(const VolumeMethod& by, const VolumeCaches& caches) {
  method = by;
  surfaces = caches.surfaces.records().size(), media = caches.media.records().size();
  for (const VolumeCache* cache : {&caches.surfaces, &caches.media})
    for (const VolumeRecord& r : cache->records()) {
      const auto& [x, y, z] = r.jet.translational;
      bytes += sizeof(r) + sizeof(Rgb) * (r.jet.value.size() + x.size() + y.size() + z.size());
    }
}

std::uint64_t Statistics::peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void Statistics::print() const {
  if (cancelled) fmt::print("interrupted: the picture is not finished\n");
  fmt::print("{} x {} pixels, {} triangles, method {}\n", width, height, triangles, method);
  if (!estimator.empty()) {
    fmt::print("  records    {} ({}, {} order{}), {} of {} samples uncovered\n", records,
               adaptive ? fmt::format("{:.0f} rays each in the mean", record_rays)
                        : fmt::format("{} x {} rays each", strata.polar, strata.azimuthal),
               lazy ? "lazy" : "rounds", lazy ? "" : fmt::format(", {} rounds", rounds), uncovered, samples);
    fmt::print("  threshold  a = {}, estimator {}, metric {}, leak test {}, regression {}\n", a, estimator, metric,
               leak_test ? "on" : "off", regress ? "on" : "off");
    fmt::print("  secondary  {}\n", describe_secondary(*this));
    fmt::print("  bounds     {}\n", bounds);
    if (glossy && glossy->records > 0)
      fmt::print(
          "  glossy     {} records of radiance ({:.1f} {} bands and {:.0f} rays each in the mean, {:.1f} MB), "
          "a = {:g}, estimator {}, metric {}\n",
          glossy->records, glossy->bands, name_of(glossy->method.basis), glossy->rays,
          static_cast<double>(glossy->bytes) / 1e6, glossy->method.settings.a, glossy->method.estimator->name,
          glossy->method.metric->name);
    if (media)
      fmt::print(
          "  media      {} records of surfaces' light, {} of media's ({:.1f} MB), a = {:g}, estimator {}, metric {}\n",
          media->surfaces, media->media, static_cast<double>(media->bytes) / 1e6, media->method.settings.a,
          media->method.estimator->name, media->method.metric->name);
  }
  fmt::print(
      "  CPU        load {:.2f} s, build {:.2f} s, final {:.2f} s, check {:.2f} s; wall {:.2f} s on {} threads\n",
      time.load.cpu, time.build.cpu, time.final.cpu, time.check.cpu, time.total.wall, threads);
  fmt::print("  rays       {} camera, {} gather, {} path, {} shadow, {} check, {} verification\n", rays.camera,
             rays.gather, rays.path, rays.shadow, rays.check, rays.verification);
  fmt::print("  memory     {:.0f} MB at the peak\n", static_cast<double>(peak_memory()) / 1e6);
  if (error.points > 0)
    fmt::print(
        "  error      {}{}measured {:.3g} at {} random visible points (median {:.3g}, 95th percentile {:.3g}, "
        "largest {:.3g} at pixel {},{}, bias {:+.3g}; the measurement's own noise is {:.2g})\n",
        error_asked ? fmt::format("asked {:.3g}, ", *error_asked) : "",
        refinements ? fmt::format("after {} refinement{} ", refinements, refinements == 1 ? "" : "s") : "", error.mean,
        error.points, error.median, error.p95, error.largest, error.largest_x, error.largest_y, error.bias,
        error.noise);
  if (checked && error.points == 0)
    fmt::print("  error      {}\n",
               error.cancelled ? "not measured: interrupted" : "no visible point could be measured");
  if (error.points == 0 || !error_asked) return;
  if (error.exceeds(*error_asked))
    fmt::print("             above the asked error; {}\n",
               adaptive && !lazy ? "--refine N works on that" : "more --rays lower the records' own noise");
  else if (error.mean > 1.5 * *error_asked)
    fmt::print("             whether the asked error is met is not measurable at this noise\n");
}

void Statistics::write_json(const std::string& path) const {
  const auto phases = [&](double Clock::*field) {
    return Json{{"load", time.load.*field},
                {"build", time.build.*field},
                {"check", time.check.*field},
                {"final", time.final.*field},
                {"total", time.total.*field}};
  };
  Json json{{"method", method},
            {"records", records},
            {"uncovered", uncovered},
            {"samples", samples},
            {"rounds", rounds},
            {"passes", passes},
            {"refinements", refinements},
            {"rays",
             {{"camera", rays.camera},
              {"shadow", rays.shadow},
              {"gather", rays.gather},
              {"path", rays.path},
              {"check", rays.check},
              {"verification", rays.verification},
              {"total", rays.total()}}},
            {"cpu_seconds", phases(&Clock::cpu)},
            {"wall_seconds", phases(&Clock::wall)},
            {"peak_memory_bytes", peak_memory()},
            {"threads", threads},
            {"seed", seed},
            {"width", width},
            {"height", height},
            {"triangles", triangles},
            {"cancelled", cancelled}};
  if (!estimator.empty()) {
    json["parameters"] = parameters(*this);
    json["glossy"] = glossy ? glossy_records(*glossy) : Json(nullptr);
    json["media"] = media ? media_records(*media) : Json(nullptr);
    json["error"] = measured(error, error_asked);
  }
  AtomicFile file(path);
  file.stream() << json.dump(2) << "\n";
  file.commit();
}

}  // namespace isophote::app
