#include "isophote/apps/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
     "rough enough (methods cached, krivanek2005a and krivanek2005b: auto, others: rays)",
     [](S& s, T t) { s.glossy = glossy(t); }, true},
    {"method", "glossy-estimator", "NAME", "another estimator of incident radiance than the method's",
     [](S& s, T t) { s.glossy_estimator = find_radiance_estimator(t).name; }, true},
    {"method", "glossy-metric", "NAME", "another metric for records of incident radiance than the method's",
     [](S& s, T t) { s.glossy_metric = find_metric(t).name; }, true},
    {"method", "glossy-a", "A", "threshold of that metric (default: by --error, or the error that --a aims at)",
     [](S& s, T t) { s.glossy_a = number<float>(t, least_threshold, greatest_threshold); }, true},
    {"method", "glossy-basis", "spherical|hemispherical",
     "harmonics that hold incident radiance (default: hemispherical)", [](S& s, T t) { s.basis = basis(t); }, true},
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
    {"method", "aspect", "N", "of elliptical footprints at most; 1: disks",
     [](S& s, T t) { s.aspect = number<float>(t, 1, 1e6); }, true},
    {"method", "weight", "ward|tent|tabellion", "how the weight of a record falls towards its rim",
     [](S& s, T t) { s.weight = falloff(t); }, true},
    {"method", "seed", "N", "of the random numbers (default: 0)",
     [](S& s, T t) { s.seed = number<std::uint64_t>(t, 0, 9e15); }},
};

Vec3 point(const std::string& text) {
  std::istringstream in(text);
  std::vector<float> v;
  for (std::string part; std::getline(in, part, ',');) v.push_back(number<float>(part, -1e30, 1e30));
  if (v.size() != 3) throw UsageError(fmt::format("--camera: wants x,y,z, not '{}'", text));
  return {v[0], v[1], v[2]};
}

/// A radius cannot obey a lower bound above the upper one, be that the method's own.
void check_order(const RadiusBounds& b) {
  const auto check = [](std::string_view unit, float low, float high) {
    if (low > high) throw UsageError(fmt::format("--min-{0} {1:g} is above --max-{0} {2:g}", unit, low, high));
  };
  check("pixels", b.min_pixels, b.max_pixels);
  check("radius", b.min_length, b.max_length);
}

GlossyMethod chosen_glossy(const RenderSettings& s, const Method& method) {
  GlossyMethod glossy = method.glossy;
  // For those that cache no radiance of their own, as method cached does.
  if (!glossy.caches() && s.glossy.value_or(Glossy::rays) != Glossy::rays) glossy = find_method("cached").glossy;
  glossy.from = s.glossy.value_or(glossy.from);
  if (!s.glossy_estimator.empty()) glossy.estimator = &find_radiance_estimator(s.glossy_estimator);
  if (!s.glossy_metric.empty()) glossy.metric = &find_metric(s.glossy_metric);
  glossy.basis = s.basis.value_or(glossy.basis);
  if (!glossy.caches()) {
    if (!s.glossy_estimator.empty() || !s.glossy_metric.empty() || s.glossy_a || s.basis)
      throw UsageError("--glossy-... is about records of incident radiance: it takes --glossy cache or auto");
    return glossy;
  }
  if (!glossy.metric->measure_radiance)
    throw UsageError(fmt::format("--glossy-metric {}: this metric is for irradiance alone", glossy.metric->name));
  // The error that irradiance is to have, by this metric's own scale.
  const double error = s.a ? method.error() : s.error.value_or(default_error);
  glossy.settings.a = s.glossy_a.value_or(threshold(*glossy.metric, error));
  return glossy;
}

}  // namespace

std::span<const Option> options() { return table; }

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

Method chosen_method(const RenderSettings& s) {
  Method method = find_method(s.method);
  if (!method.caches()) return method;
  if (!s.estimator.empty()) method.estimator = &find_estimator(s.estimator);
  if (!s.metric.empty()) {
    method.metric = &find_metric(s.metric);
    if (!method.metric->bounded) method.settings.bounds = {};
    if (!method.metric->by_gradient) method.settings.bounds.gradient = false;
    if (!method.metric->elliptical) method.settings.aspect = 1;
  }
  RadiusBounds& bounds = method.settings.bounds;
  bounds.min_pixels = s.min_pixels.value_or(bounds.min_pixels);
  bounds.max_pixels = s.max_pixels.value_or(bounds.max_pixels);
  bounds.min_view = s.min_view.value_or(bounds.min_view);
  bounds.max_view = s.max_view.value_or(bounds.max_view);
  bounds.min_length = s.min_radius.value_or(bounds.min_length);
  bounds.max_length = s.max_radius.value_or(bounds.max_length);
  bounds.gradient = s.bound_gradient.value_or(bounds.gradient);
  bounds.neighbours = s.bound_neighbours.value_or(bounds.neighbours);
  check_order(bounds);
  method.settings.aspect = s.aspect.value_or(method.settings.aspect);
  method.settings.falloff = s.weight;
  if (s.extrapolate.value_or(0) > method.estimator->order)
    throw UsageError(fmt::format("--extrapolate {}: estimator '{}' gives no such derivatives", *s.extrapolate,
                                 method.estimator->name));
  method.order = s.extrapolate.value_or(method.order);
  method.settings.a = s.a ? *s.a : threshold(*method.metric, s.error.value_or(default_error));
  // A cached value has no depth: with a limit on depth, gather rays follow their paths.
  method.secondary = s.secondary.value_or(s.max_depth ? Secondary::off : method.secondary);
  if (method.secondary != Secondary::off && s.max_depth)
    throw UsageError(
        fmt::format("--secondary {} has no limit of depth: leave out --max-depth", name_of(method.secondary)));
  // A number of records is for comparisons: their rays are given, not chosen.
  method.adaptive = s.rays ? *s.rays == 0 : method.adaptive && !s.records;
  method.leak_test = s.leak_test.value_or(method.leak_test);
  // In Ward's order pixels have been drawn before the last record is made.
  method.regress =
      s.regress.value_or(method.regress && !s.lazy && method.leak_test && method.estimator->gradient_error);
  if (method.regress && s.lazy)
    throw UsageError("--regress on wants all records before the first pixel: no --order lazy");
  if (method.regress && !method.leak_test)
    throw UsageError("--regress on would fit records to what lies behind a wall: it takes --leak-test on");
  if (method.regress && !method.estimator->gradient_error)
    throw UsageError(fmt::format("--regress on needs gradients and their errors, which estimator '{}' does not give",
                                 method.estimator->name));
  method.glossy = chosen_glossy(s, method);
  check_combination(method);
  return method;
}

std::string describe(const RadiusBounds& b) {
  std::string text;
  const auto add = [&](const std::string& s) { text += (text.empty() ? "" : ", ") + s; };
  if (b.min_pixels > 0) add(fmt::format("at least {:g} px", b.min_pixels));
  if (b.max_pixels < std::numeric_limits<float>::infinity()) add(fmt::format("at most {:g} px", b.max_pixels));
  if (b.min_view > 0) add(fmt::format("at least {:g} a of the picture's height", b.min_view));
  if (b.max_view < std::numeric_limits<float>::infinity())
    add(fmt::format("at most {:g} of the picture's height", b.max_view));
  if (b.min_length > 0) add(fmt::format("at least {:g} scene units", b.min_length));
  if (b.max_length < std::numeric_limits<float>::infinity()) add(fmt::format("at most {:g} scene units", b.max_length));
  if (b.gradient) add("gradient");
  if (b.neighbours > 0) add(fmt::format("neighbours at slope {:g}", b.neighbours));
  return text.empty() ? "none" : text;
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
