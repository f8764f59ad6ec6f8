#include <fmt/format.h>

#include <limits>

#include "isophote/apps/settings.h"
#include "isophote/core/error.h"

namespace isophote::app {
namespace {

/// A radius cannot obey a lower bound above the upper one, be that the method's own.
void check_order(const RadiusBounds& b) {
  const auto check = [](std::string_view unit, float low, float high) {
    if (low > high) throw UsageError(fmt::format("--min-{0} {1:g} is above --max-{0} {2:g}", unit, low, high));
  };
  check("pixels", b.min_pixels, b.max_pixels);
  check("radius", b.min_length, b.max_length);
}

/// Those that settings say, where they do.
void apply_bounds(const RenderSettings& s, RadiusBounds& bounds) {
  bounds.min_pixels = s.min_pixels.value_or(bounds.min_pixels);
  bounds.max_pixels = s.max_pixels.value_or(bounds.max_pixels);
  bounds.min_view = s.min_view.value_or(bounds.min_view);
  bounds.max_view = s.max_view.value_or(bounds.max_view);
  bounds.min_length = s.min_radius.value_or(bounds.min_length);
  bounds.max_length = s.max_radius.value_or(bounds.max_length);
  bounds.gradient = s.bound_gradient.value_or(bounds.gradient);
  bounds.neighbours = s.bound_neighbours.value_or(bounds.neighbours);
  check_order(bounds);
}

GlossyMethod chosen_glossy(const RenderSettings& s, const Method& method) {
  GlossyMethod glossy = method.glossy;
  // For those that cache no radiance of their own, as method cached does.
  if (!glossy.caches() && s.glossy.value_or(Glossy::rays) != Glossy::rays) glossy = find_method("cached").glossy;
  glossy.from = s.glossy.value_or(glossy.from);
  if (!s.glossy_estimator.empty()) glossy.estimator = &find_radiance_estimator(s.glossy_estimator);
  if (!s.glossy_metric.empty()) glossy.metric = &find_metric(s.glossy_metric);
  glossy.basis = s.basis.value_or(glossy.basis);
  glossy.window = s.glossy_window.value_or(glossy.window);
  glossy.contrast = s.glossy_contrast.value_or(s.lazy ? 0 : glossy.contrast);
  if (glossy.contrast > 0 && s.lazy)
    throw UsageError("--glossy-contrast shrinks records between rounds: no --order lazy");
  if (!glossy.caches()) {
    if (!s.glossy_estimator.empty() || !s.glossy_metric.empty() || s.glossy_a || s.basis || s.glossy_contrast ||
        s.glossy_window)
      throw UsageError("--glossy-... is about records of incident radiance: it takes --glossy cache or auto");
    return glossy;
  }
  if (!glossy.metric->measure_radiance)
    throw UsageError(fmt::format("--glossy-metric {}: this metric is for irradiance alone", glossy.metric->name));
  if (glossy.metric->bounded) {
    apply_bounds(s, glossy.settings.bounds);
  } else {
    // Without a floor, what noise makes records differ by would shrink them to nothing.
    if (s.glossy_contrast.value_or(0) > 0)
      throw UsageError(fmt::format("--glossy-contrast wants a metric with bounds: not {}", glossy.metric->name));
    glossy.settings.bounds = {};
    glossy.contrast = 0;
  }
  glossy.settings.falloff = s.weight;
  // The error that irradiance is to have, by this metric's own scale.
  const double error = s.a ? method.error() : s.error.value_or(default_error);
  glossy.settings.a = s.glossy_a.value_or(threshold(*glossy.metric, error));
  return glossy;
}

VolumeMethod chosen_volume(const RenderSettings& s, const Method& method) {
  VolumeMethod volume = method.volume;
  if (!volume.caches() && s.media.value_or(InScattering::paths) == InScattering::cache)
    volume = find_method("cached").volume;
  // A cached value has no depth, and is made before the first pixel is.
  volume.from = s.media.value_or(s.lazy || s.max_depth ? InScattering::paths : volume.from);
  if (volume.caches() && s.lazy) throw UsageError("--media cache builds in rounds: no --order lazy");
  if (volume.caches() && s.max_depth) throw UsageError("--media cache has no limit of depth: leave out --max-depth");
  if (!volume.caches()) {
    if (!s.media_estimator.empty() || !s.media_metric.empty() || s.media_a)
      throw UsageError("--media-... is about records in media: it takes --media cache");
    return volume;
  }
  if (!s.media_estimator.empty()) {
    volume.estimator = &find_volume_estimator(s.media_estimator);
    volume.settings.bounds.gradient = volume.estimator->sees_occluders;
  }
  if (!s.media_metric.empty()) volume.metric = &find_volume_metric(s.media_metric);
  if (volume.metric->bounded)
    apply_bounds(s, volume.settings.bounds);
  else
    volume.settings.bounds = {};
  if (!volume.metric->by_gradient) volume.settings.bounds.gradient = false;
  volume.settings.aspect = volume.metric->elliptical ? s.aspect.value_or(volume.settings.aspect) : 1;
  const double error = s.a ? method.error() : s.error.value_or(default_error);
  volume.settings.a = s.media_a.value_or(threshold(*volume.metric, error));
  return volume;
}

}  // namespace

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
  apply_bounds(s, method.settings.bounds);
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
  method.volume = chosen_volume(s, method);
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

}  // namespace isophote::app
