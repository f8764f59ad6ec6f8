#include "isophote/cache/catalogue.h"

#include <limits>

#include "isophote/cache/catalogue_rows.h"
#include "isophote/core/error.h"
#include "isophote/derivatives/jarosz_2008b.h"
#include "isophote/derivatives/jarosz_2012.h"
#include "isophote/derivatives/krivanek_2005a.h"
#include "isophote/derivatives/krivanek_2005b.h"
#include "isophote/derivatives/schwarzhaupt_2012.h"
#include "isophote/derivatives/swept_edges.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "isophote/validity/bounded_split_sphere.h"
#include "isophote/validity/settle.h"
#include "isophote/validity/split_sphere.h"
#include "isophote/validity/total_error.h"
#include "isophote/validity/uniform.h"

namespace isophote {
namespace {

constexpr Estimator estimator_table[] = {
    {"irradiance", "[Ward, Rubinstein, Clear 1988]", "value", 0, irradiance},
    {"ward-heckbert", "[Ward, Heckbert 1992]", "value, gradients (classical rotation)", 1,
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::classical); }},
    {"ward-heckbert-exact", "[Ward, Heckbert 1992]", "value, gradients (exact rotation weights)", 1,
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact); }},
    {"ward-heckbert-harmonic", "[Ward, Heckbert 1992]", "the same, walls on one surface at their harmonic mean", 1,
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact, WallDistance::harmonic); }},
    {"layered", "[Jarosz 2008b]", "value, gradients that know of media", 1,
     [](const HemisphereGather& g) { return jarosz_2008b(g); }},
    {"surface-area", "[Krivanek 2005a]", "value, gradients unaware of occlusion", 1, krivanek_2005a},
    {"surface-area-hessian", "[Jarosz 2012]", "value, gradients, Hessian unaware of occlusion", 2, jarosz_2012},
    {"triangulated", "[Schwarzhaupt 2012]", "value, gradients, Hessian", 2,
     [](const HemisphereGather& g) { return schwarzhaupt_2012(g, Horizon::closed); }},
    {"triangulated-open", "[Schwarzhaupt 2012]", "the same, open at the horizon", 2,
     [](const HemisphereGather& g) { return schwarzhaupt_2012(g, Horizon::open); }},
    {"swept-edges", "", "value, gradients, Hessian", 2, swept_edges, true},
};

constexpr RadianceEstimator radiance_table[] = {
    {"radiance", "[Krivanek 2005a]", "value", 0, incident_radiance},
    {"radiance-surface-area", "[Krivanek 2005a]", "value, gradient unaware of occlusion", 1,
     [](const HemisphereGather& g, Basis basis, int bands) { return krivanek_2005a(g, basis, bands); }},
    {"radiance-stratified", "[Krivanek 2005b]", "value, gradient", 1, krivanek_2005b},
};

template <class R>
void settle_by(const SettlingOf<R>& settling, std::span<const std::uint32_t> fresh, const MetricSettings& s,
               float scale) {
  settle(settling, fresh, {.scale = scale, .slope = s.bounds.neighbours});
}

float split_sphere_scale(const MetricSettings& s) { return split_sphere_radius(1, s.a); }

constexpr Metric metric_table[] = {
    {.name = "split-sphere",
     .paper = "[Ward, Rubinstein, Clear 1988]",
     .a_factor = 1.4f,
     .a_power = 0.5f,
     .measure = [](const Jet<Rgb>& jet, const View& view,
                   const MetricSettings& s) { return split_sphere(jet.distances, view, s.a); },
     .scale = split_sphere_scale,
     .measure_radiance = [](const RadianceJet& jet, const View& view,
                            const MetricSettings& s) { return split_sphere(jet.distances, view, s.a); }},
    {.name = "bounded-split-sphere",
     .paper = "[Krivanek 2006]",
     .bounded = true,
     .by_gradient = true,
     .a_factor = 1.4f,
     .a_power = 0.5f,
     .measure = [](const Jet<Rgb>& jet, const View& view,
                   const MetricSettings& s) { return bounded_split_sphere(jet, view, s.a, s.bounds); },
     .settle = [](const Settling& settling, std::span<const std::uint32_t> fresh,
                  const MetricSettings& s) { settle_by(settling, fresh, s, split_sphere_scale(s)); },
     .scale = split_sphere_scale,
     .measure_radiance = [](const RadianceJet& jet, const View& view,
                            const MetricSettings& s) { return bounded_split_sphere(jet, view, s.a, s.bounds); },
     .settle_radiance = [](const SettlingOf<RadianceRecord>& settling, std::span<const std::uint32_t> fresh,
                           const MetricSettings& s) { settle_by(settling, fresh, s, split_sphere_scale(s)); }},
    {.name = "total-error",
     .paper = "[Jarosz 2012]",
     .bounded = true,
     .elliptical = true,
     .needs = 2,
     .a_factor = 2,
     .measure = [](const Jet<Rgb>& jet, const View& view,
                   const MetricSettings& s) { return total_error(jet, view, s.a, s.bounds, s.aspect); },
     .settle = [](const Settling& settling, std::span<const std::uint32_t> fresh,
                  const MetricSettings& s) { settle_by(settling, fresh, s, 1); }},
    {.name = "uniform",
     .a_factor = 1.4f,
     .a_power = 0.5f,
     .measure = [](const Jet<Rgb>&, const View& view, const MetricSettings& s) { return uniform(view, s.a); },
     .settle = [](const Settling& settling, std::span<const std::uint32_t> fresh,
                  const MetricSettings& s) { settle_by(settling, fresh, s, 1); },
     .measure_radiance = [](const RadianceJet&, const View& view,
                            const MetricSettings& s) { return uniform(view, s.a); }},
};

/// The row of a name, which must be there for this to compile.
template <class Table>
consteval const auto& row(const Table& table, std::string_view name) {
  for (const auto& entry : table)
    if (entry.name == name) return entry;
  throw "there is no such row";
}
constexpr const Estimator &no_gradients = row(estimator_table, "irradiance"),
                          &classical = row(estimator_table, "ward-heckbert"),
                          &exact = row(estimator_table, "ward-heckbert-exact"),
                          &layered = row(estimator_table, "layered"), &pieces = row(estimator_table, "surface-area"),
                          &unaware = row(estimator_table, "surface-area-hessian"),
                          &triangulated = row(estimator_table, "triangulated"),
                          &swept = row(estimator_table, "swept-edges");
constexpr const RadianceEstimator &radiance_unaware = row(radiance_table, "radiance-surface-area"),
                                  &radiance_aware = row(radiance_table, "radiance-stratified");
constexpr const Metric &split = row(metric_table, "split-sphere"), &bounded = row(metric_table, "bounded-split-sphere"),
                       &total = row(metric_table, "total-error"), &one_radius = row(metric_table, "uniform");

constexpr float any_aspect = std::numeric_limits<float>::infinity();
const RadiusBounds bounded_preset{.min_pixels = 1.5f, .max_pixels = 20, .gradient = true, .neighbours = 1};
const RadiusBounds cached_preset{.min_pixels = 1.5f, .min_view = 0.08f, .max_view = 0.03f, .neighbours = 1};
const RadiusBounds radiance_preset{.min_pixels = 1.5f, .min_view = 0.04f, .max_view = 0.1f, .neighbours = 1};
const RadiusBounds gradient_preset{.min_pixels = 1.5f, .gradient = true, .neighbours = 1};
const RadiusBounds safety{.min_pixels = 1.5f}, swept_preset{.min_pixels = 1.5f, .neighbours = 1};
// In media; where gradients see edges, which the samples' own do not, `gradient_preset`.
const RadiusBounds volume_preset{.min_pixels = 1.5f, .neighbours = 1};
constexpr float volume_aspect = 4;
const VolumeMethod media_2008{InScattering::cache,
                              &find_volume_estimator("volume-unaware"),
                              &find_volume_metric("relative-change"),
                              {.bounds = volume_preset},
                              true};

// One line a method. A new one needs its estimator or metric above, in a file of its own, and a line here.
const Method method_table[] = {
    {"path", "[Veach, Guibas 1995]", "path tracing: the unbiased reference"},
    {"ward1988", "[Ward, Rubinstein, Clear 1988]", "split sphere, values alone", &no_gradients, &split, {}, 0},
    {"ward1992", "[Ward, Heckbert 1992]", "split sphere, gradients", &classical, &split, {}, 1},
    {"bounded",
     "[Tabellion, Lamorlette 2004] [Krivanek 2006]",
     "split sphere within bounds",
     &exact,
     &bounded,
     {.bounds = bounded_preset},
     1},
    {.name = "krivanek2005a",
     .paper = "[Krivanek 2005a]",
     .summary = "split sphere, gradients in surface-area form, glossy lobes too",
     .estimator = &pieces,
     .metric = &split,
     .order = 1,
     .glossy = {Glossy::automatic, &radiance_unaware, &split}},
    {.name = "krivanek2005b",
     .paper = "[Krivanek 2005b]",
     .summary = "split sphere, stratified gradients, glossy lobes too",
     .estimator = &exact,
     .metric = &split,
     .order = 1,
     .glossy = {Glossy::automatic, &radiance_aware, &split}},
    {.name = "krivanek2006",
     .paper = "[Krivanek 2006]",
     .summary = "split sphere bounded by gradients and neighbours, glossy lobes by records whose radii adapt",
     .estimator = &exact,
     .metric = &bounded,
     .settings = {.bounds = gradient_preset},
     .order = 1,
     .glossy =
         {Glossy::automatic, &radiance_aware, &bounded, {.bounds = gradient_preset}, Basis::hemispherical, 0, 0.1f}},
    {"jarosz2012", "[Jarosz 2012]", "Hessian unaware of occlusion", &unaware, &total, {.bounds = safety}, 1},
    {"schwarzhaupt2012",
     "[Schwarzhaupt 2012]",
     "Hessian of the triangulated hemisphere, ellipses",
     &triangulated,
     &total,
     {.bounds = safety, .aspect = any_aspect},
     1},
    {.name = "jarosz2008a",
     .paper = "[Jarosz 2008a]",
     .summary = "light in media by relative change and in logarithms; surfaces as `bounded`",
     .estimator = &exact,
     .metric = &bounded,
     .settings = {.bounds = bounded_preset},
     .order = 1,
     .volume = media_2008},
    {.name = "jarosz2008b",
     .paper = "[Jarosz 2008b]",
     .summary = "gradients of irradiance that know of media and occlusion; light in media as `jarosz2008a`",
     .estimator = &layered,
     .metric = &bounded,
     .settings = {.bounds = bounded_preset},
     .order = 1,
     .volume = media_2008},
    {.name = "marco2018",
     .paper = "[Marco 2018]",
     .summary = "light in media by Hessians that see occluders, ellipsoids; surfaces as `schwarzhaupt2012`",
     .estimator = &triangulated,
     .metric = &total,
     .settings = {.bounds = safety, .aspect = any_aspect},
     .order = 1,
     .volume = {InScattering::cache,
                &find_volume_estimator("volume-triangulated"),
                &find_volume_metric("volume-error"),
                {.bounds = gradient_preset, .aspect = volume_aspect}}},
    {"swept",
     "",
     "Hessian by swept edges, ellipses, second order",
     &swept,
     &total,
     {.bounds = swept_preset, .aspect = 2},
     2},
    {"uniform", "", "one radius everywhere: the control", &swept, &one_radius, {}, 1},
    {"cached",
     "",
     "the best combination there is here",
     &swept,
     &total,
     {.bounds = cached_preset, .aspect = 2},
     2,
     Secondary::automatic,
     true,
     true,
     true,
     {Glossy::automatic, &radiance_aware, &bounded, {.bounds = radiance_preset}, Basis::hemispherical, 2},
     {InScattering::cache,
      &find_volume_estimator("volume-walls"),
      &find_volume_metric("relative-change"),
      {.bounds = gradient_preset},
      true}},
};

}  // namespace

std::string_view name_of(Secondary secondary) {
  constexpr std::string_view names[] = {"off", "cells", "records", "auto"};
  return names[static_cast<int>(secondary)];
}

std::string_view name_of(Glossy glossy) {
  constexpr std::string_view names[] = {"rays", "cache", "auto"};
  return names[static_cast<int>(glossy)];
}
std::string_view name_of(Basis basis) { return basis == Basis::spherical ? "spherical" : "hemispherical"; }

std::span<const RadianceEstimator> radiance_estimators() { return radiance_table; }
std::span<const Estimator> estimators() { return estimator_table; }
std::span<const Metric> metrics() { return metric_table; }
std::span<const Method> methods() { return method_table; }

Method find_method(std::string_view name) { return find_row(method_table, name, "method"); }
const Estimator& find_estimator(std::string_view name) { return find_row(estimator_table, name, "estimator"); }
const RadianceEstimator& find_radiance_estimator(std::string_view name) {
  return find_row(radiance_table, name, "estimator of radiance");
}
const Metric& find_metric(std::string_view name) { return find_row(metric_table, name, "metric"); }

float threshold(const Metric& metric, double error) { return threshold_of(metric, error); }

void check_combination(const Method& method) {
  if (!method.caches()) return;
  if (method.volume.caches()) check_combination(method.volume);
  const auto pair = [&] {
    return "metric '" + std::string(method.metric->name) + "' and estimator '" + std::string(method.estimator->name) +
           "': ";
  };
  if (method.estimator->order < method.metric->needs)
    throw UsageError(pair() + "this metric needs a Hessian, which this estimator does not give");
  if (method.settings.bounds.gradient && method.estimator->order == 0)
    throw UsageError(pair() + "the bound by the gradient needs a gradient, which this estimator does not give");
  if (!method.metric->bounded && method.settings.bounds != RadiusBounds{})
    throw UsageError(pair() + "this metric heeds no bounds on the radius; 'bounded-split-sphere' does");
  if (!method.metric->by_gradient && method.settings.bounds.gradient)
    throw UsageError(pair() + "this metric heeds no bound by the gradient; 'bounded-split-sphere' does");
  if (!method.metric->elliptical && method.settings.aspect > 1)
    throw UsageError(pair() + "this metric's footprints are disks; those of 'total-error' may be ellipses");
}

}  // namespace isophote
