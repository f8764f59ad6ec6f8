#include "isophote/apps/settings.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "isophote/core/error.h"

namespace isophote::app {
namespace {

/// The whole of `text` as a number within [low, high].
template <class T>
T number(const std::string& text, double low, double high) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  const bool whole = !std::is_integral_v<T> || value == std::floor(value);
  if (used != text.size() || !std::isfinite(value) || value < low || value > high || !whole)
    throw UsageError(fmt::format("wants a{} number from {} to {}, not '{}'", std::is_integral_v<T> ? " whole" : "", low,
                                 high, text));
  return static_cast<T>(value);
}

bool on_off(const std::string& text) {
  if (text != "on" && text != "off") throw UsageError(fmt::format("wants on or off, not '{}'", text));
  return text == "on";
}

/// "512x512"; scene files may also say [512, 512].
void size(RenderSettings& s, const std::string& text) {
  const std::size_t cross = text.find_first_of("x,");
  if (cross == std::string::npos) throw UsageError(fmt::format("wants WIDTHxHEIGHT, not '{}'", text));
  s.width = number<int>(text.substr(0, cross), 1, 32768);
  s.height = number<int>(text.substr(cross + 1), 1, 32768);
}

Falloff falloff(const std::string& text) {
  if (text == "ward") return Falloff::ward;
  if (text == "tent") return Falloff::tent;
  if (text == "tabellion") return Falloff::tabellion;
  throw UsageError(fmt::format("wants ward, tent or tabellion, not '{}'", text));
}

Secondary secondary(const std::string& text) {
  for (const Secondary s : {Secondary::off, Secondary::cells, Secondary::records, Secondary::automatic})
    if (text == name_of(s)) return s;
  throw UsageError(fmt::format("wants off, cells, records or auto, not '{}'", text));
}

InScattering in_scattering(const std::string& text) {
  for (const InScattering s : {InScattering::paths, InScattering::cache})
    if (text == name_of(s)) return s;
  throw UsageError(fmt::format("wants cache or paths, not '{}'", text));
}

Glossy glossy(const std::string& text) {
  for (const Glossy g : {Glossy::rays, Glossy::cache, Glossy::automatic})
    if (text == name_of(g)) return g;
  throw UsageError(fmt::format("wants cache, rays or auto, not '{}'", text));
}

Basis basis(const std::string& text) {
  for (const Basis b : {Basis::spherical, Basis::hemispherical})
    if (text == name_of(b)) return b;
  throw UsageError(fmt::format("wants spherical or hemispherical, not '{}'", text));
}

using S = RenderSettings;  // the two parameter types of every line below
using T = const std::string&;

constexpr Option table[] = {
    {"film", "size", "WxH", "picture size in pixels (default: 512 high); keeps the vertical field of view", size},
    {"film", "camera", "CAMERA",
     "name or index of a camera of the scene (default: its first), or 'x,y,z;x,y,z;degrees' for eye, target, field of "
     "view",
     [](S& s, T t) { s.camera = t; }},
    {"film", "spp", "N", "samples a pixel (default: 16)", [](S& s, T t) { s.samples = number<int>(t, 1, 1 << 16); }},
    {"film", "exposure", "EV|auto", "stops, for PNG pictures (default: auto)",
     [](S& s, T t) { s.exposure = t == "auto" ? std::nullopt : std::optional(number<float>(t, -100, 100)); }},
    {"method", "method", "NAME", "one of those that 'isophote methods' lists (default: cached)",
     [](S& s, T t) { s.method = find_method(t).name; }},
    {"method", "estimator", "NAME", "another estimator than the method's",
     [](S& s, T t) { s.estimator = find_estimator(t).name; }, true},
    {"method", "metric", "NAME", "another metric than the method's", [](S& s, T t) { s.metric = find_metric(t).name; },
     true},
    {"method", "error", "E",
     "wanted mean relative error of the cached irradiance (default: 0.03); decides the threshold; method path "
     "ignores it",
     [](S& s, T t) { s.error = number<double>(t, 1e-5, 10), s.a.reset(), s.records.reset(); }},
    {"method", "a", "A", "the metric's own threshold, in place of --error",
     [](S& s, T t) { s.a = number<float>(t, least_threshold, greatest_threshold), s.error.reset(), s.records.reset(); },
     true},
    {"method", "records", "N", "solve for the threshold that gives about N records",
     [](S& s, T t) { s.records = number<int>(t, 1, 10'000'000), s.error.reset(), s.a.reset(); }, true},
    {"method", "rays", "N|auto",
     "gather rays of a record; auto: as many as the wanted error asks (default: auto for method cached, 800 for "
     "others; "
     "method path ignores it)",
     [](S& s, T t) { s.rays = t == "auto" ? 0 : number<int>(t, 12, 1 << 24); }},
    {"method", "secondary", "off|cells|records|auto",
     "what gather rays read where they hit: nothing, so that paths go on; irradiance averaged over the cells of grids; "
     "the records so far, and cells elsewhere; auto: records or off, by a pilot (method cached: auto)",
     [](S& s, T t) { s.secondary = secondary(t); }, true},
    {"method", "leak-test", "on|off",
     "are records tested for what stands between them and a point? (method cached: on)",
     [](S& s, T t) { s.leak_test = on_off(t); }, true},
    {"method", "regress", "on|off",
     "is each record fitted to what its neighbours say of it, once all are made? (method cached: on)",
     [](S& s, T t) { s.regress = on_off(t); }, true},
    {"method", "glossy", "cache|rays|auto",
     "what glossy lobes reflect: records of incident radiance; what a ray meets; auto: records where the surface is "
     "rough enough (methods cached, krivanek2005a, 2005b and 2006: auto, others: rays)",
     [](S& s, T t) { s.glossy = glossy(t); }, true},
    {"method", "glossy-estimator", "NAME", "another estimator of incident radiance than the method's",
     [](S& s, T t) { s.glossy_estimator = find_radiance_estimator(t).name; }, true},
    {"method", "glossy-metric", "NAME", "another metric for records of incident radiance than the method's",
     [](S& s, T t) { s.glossy_metric = find_metric(t).name; }, true},
    {"method", "glossy-a", "A", "threshold of that metric (default: by --error, or the error that --a aims at)",
     [](S& s, T t) { s.glossy_a = number<float>(t, least_threshold, greatest_threshold); }, true},
    {"method", "glossy-basis", "spherical|hemispherical",
     "harmonics that hold incident radiance (default: hemispherical)", [](S& s, T t) { s.basis = basis(t); }, true},
    {"method", "glossy-contrast", "C",
     "part of what is reflected by which records of incident radiance may differ where they overlap, before they "
     "shrink; 0: any (method krivanek2006: 0.1)",
     [](S& s, T t) { s.glossy_contrast = number<float>(t, 0, 1); }, true},
    {"method", "media", "cache|paths", "what media take the light from that they scatter more than once or of surfaces",
     [](S& s, T t) { s.media = in_scattering(t); }},
    {"method", "media-estimator", "NAME", "another estimator of radiance in media than the method's",
     [](S& s, T t) { s.media_estimator = find_volume_estimator(t).name; }, true},
    {"method", "media-metric", "NAME", "another metric for records in media than the method's",
     [](S& s, T t) { s.media_metric = find_volume_metric(t).name; }, true},
    {"method", "media-a", "A", "threshold of that metric (default: by --error, or the error that --a aims at)",
     [](S& s, T t) { s.media_a = number<float>(t, least_threshold, 100); }, true},
    {"method", "glossy-window", "on|off",
     "do the later harmonics of a lobe count less (Hanning's window), against ringing? (default: off)",
     [](S& s, T t) { s.glossy_window = on_off(t); }, true},
    {"method", "max-depth", "N", "scattering events after the camera; 1 is direct light (default: no limit)",
     [](S& s, T t) { s.max_depth = number<int>(t, 1, 1 << 30); }},
    {"method", "order", "rounds|lazy", "how the cache is built (default: rounds)",
     [](S& s, T t) {
       if (t != "rounds" && t != "lazy") throw UsageError(fmt::format("wants rounds or lazy, not '{}'", t));
       s.lazy = t == "lazy";
     },
     true},
    {"method", "min-pixels", "N", "lower bound of radii, in pixels",
     [](S& s, T t) { s.min_pixels = number<float>(t, 0, 1e6); }, true},
    {"method", "max-pixels", "N", "upper bound of radii, in pixels",
     [](S& s, T t) { s.max_pixels = number<float>(t, 0, 1e6); }, true},
    {"method", "min-view", "H", "lower bound of radii, in heights of the picture, times the threshold a",
     [](S& s, T t) { s.min_view = number<float>(t, 0, 1e6); }, true},
    {"method", "max-view", "H", "upper bound of radii, in heights of the picture",
     [](S& s, T t) { s.max_view = number<float>(t, 0, 1e6); }, true},
    {"method", "min-radius", "R", "lower bound of radii, in scene units",
     [](S& s, T t) { s.min_radius = number<float>(t, 0, 1e30); }, true},
    {"method", "max-radius", "R", "upper bound of radii, in scene units",
     [](S& s, T t) { s.max_radius = number<float>(t, 0, 1e30); }, true},
    {"method", "bound-gradient", "on|off", "bound radii by the relative gradient",
     [](S& s, T t) { s.bound_gradient = on_off(t); }, true},
    {"method", "bound-neighbours", "off|SLOPE", "bound radii by those of neighbours plus SLOPE times their distance",
     [](S& s, T t) { s.bound_neighbours = t == "off" ? 0 : number<float>(t, 0, 1e6); }, true},
    {"method", "extrapolate", "0|1|2", "by values alone, gradients, or the Hessian too (default: the method's)",
     [](S& s, T t) { s.extrapolate = number<int>(t, 0, 2); }, true},
    {"method", "aspect", "N", "of elliptical footprints at most; 1: disks, and balls in media",
     [](S& s, T t) { s.aspect = number<float>(t, 1, 1e6); }, true},
    {"method", "weight", "ward|tent|tabellion", "how the weight of a record falls towards its rim",
     [](S& s, T t) { s.weight = falloff(t); }, true},
    {"method", "seed", "N", "of the random numbers (default: 0)",
     [](S& s, T t) { s.seed = number<std::uint64_t>(t, 0, 9e15); }},
};

/// A point of --camera.
Vec3 point(const std::string& text) {
  try {
    return parsed_triple(text);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--camera: {}", error.what()));
  }
}

}  // namespace

std::span<const Option> options() { return table; }

Vec3 parsed_triple(const std::string& text) {
  std::istringstream in(text);
  std::vector<float> v;
  for (std::string part; std::getline(in, part, ',');) v.push_back(number<float>(part, -1e30, 1e30));
  if (v.size() != 3) throw UsageError(fmt::format("wants x,y,z, not '{}'", text));
  return {v[0], v[1], v[2]};
}

void apply_setting(RenderSettings& settings, const std::string& table_name, const std::string& name,
                   const std::string& value, const std::string& place) {
  for (const Option& option : table) {
    if (option.table != table_name || option.name != name) continue;
    try {
      return option.apply(settings, value);
    } catch (const UsageError& error) {
      throw UserError(fmt::format("{}: {}: {}", place, name, error.what()));
    }
  }
  std::string known;
  for (const Option& option : table)
    if (option.table == table_name) known += (known.empty() ? "" : ", ") + std::string(option.name);
  throw UserError(fmt::format("{}: unknown key '{}' in [{}]; there are: {}", place, name, table_name, known));
}

Camera chosen_camera(const RenderSettings& s, const Scene& scene) {
  if (s.camera.empty()) return scene.cameras.front();
  if (s.camera.find(';') != std::string::npos) {
    std::istringstream in(s.camera);
    std::string eye, target, fov;
    std::getline(in, eye, ';'), std::getline(in, target, ';'), std::getline(in, fov);
    const Vec3 from = point(eye), to = point(target);
    if (from == to) throw UsageError("--camera: eye and target are the same point");
    try {
      return Camera::look_at(from, to, number<float>(fov, 0.01, 179) * pi / 180);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--camera: field of view: {}", error.what()));
    }
  }
  std::string known;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (s.camera == scene.cameras[i].name || s.camera == std::to_string(i)) return scene.cameras[i];
    known += fmt::format("{}{} '{}'", i ? ", " : "", i, scene.cameras[i].name);
  }
  throw UsageError(fmt::format("--camera: there is no '{}'; there are: {}", s.camera, known));
}

}  // namespace isophote::app
