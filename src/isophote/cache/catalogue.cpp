#include "isophote/cache/catalogue.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/error.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "isophote/validity/limit_gradient.h"
#include "isophote/validity/split_sphere.h"
#include "isophote/validity/uniform.h"

namespace isophote {
namespace {

constexpr Estimator estimator_table[] = {
    {"irradiance", "[Ward, Rubinstein, Clear 1988]", "value", false, irradiance},
    {"ward-heckbert", "[Ward, Heckbert 1992]", "value, gradients (classical rotation)", true,
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::classical); }},
    {"ward-heckbert-exact", "[Ward, Heckbert 1992]", "value, gradients (exact rotation weights)", true,
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact); }},
};

constexpr Metric metric_table[] = {
    {"split-sphere", "[Ward, Rubinstein, Clear 1988]", false, 1.4f,
     [](const Jet<Rgb>& jet, const View& view, const MetricSettings& s) { return split_sphere(jet, view, s.a); },
     nullptr},
    {"bounded-split-sphere", "[Krivanek 2006]", true, 1.4f,
     [](const Jet<Rgb>& jet, const View& view, const MetricSettings& s) {
       return bounded_split_sphere(jet, view, s.a, s.bounds);
     },
     [](const Settling& settling, std::span<const std::uint32_t> fresh, const MetricSettings& s) {
       settle_bounded(settling, fresh, s.a, s.bounds);
     }},
    {"uniform", "", false, 1.4f,
     [](const Jet<Rgb>&, const View& view, const MetricSettings& s) { return uniform(view, s.a); },
     [](const Settling& settling, std::span<const std::uint32_t> fresh, const MetricSettings&) {
       for (Record& r : settling.records.subspan(fresh.front(), fresh.size())) limit_gradient(r, r.footprint.radius);
     }},
};

constexpr const Estimator& no_gradients = estimator_table[0];
constexpr const Estimator& classical = estimator_table[1];
constexpr const Estimator& exact = estimator_table[2];
constexpr const Metric& split = metric_table[0];
constexpr const Metric& bounded = metric_table[1];
constexpr const Metric& one_radius = metric_table[2];

const RadiusBounds bounded_preset{.min_pixels = 1.5f, .max_pixels = 20, .gradient = true, .neighbours = true};
const RadiusBounds cached_preset{.min_pixels = 1.5f, .min_view = 0.15f, .neighbours = true};

// One line a method. A new one needs its estimator or metric above, in a file of its own, and a line here.
const Method method_table[] = {
    {"path", "[Veach, Guibas 1995]", "path tracing: the unbiased reference", nullptr, nullptr, {}, false},
    {"ward1988", "[Ward, Rubinstein, Clear 1988]", "split sphere, values alone", &no_gradients, &split, {}, false},
    {"ward1992", "[Ward, Heckbert 1992]", "split sphere, gradients", &classical, &split, {}, false},
    {"bounded",
     "[Tabellion, Lamorlette 2004] [Krivanek 2006]",
     "split sphere within bounds",
     &exact,
     &bounded,
     {.a = 0.2f, .bounds = bounded_preset},
     false},
    {"uniform", "", "one radius everywhere: the control", &exact, &one_radius, {}, false},
    {"cached", "", "the best combination there is here", &exact, &bounded, {.a = 0.2f, .bounds = cached_preset}, true},
};

template <class Table>
const auto& find(const Table& table, std::string_view name, const char* kind) {
  std::string known;
  for (const auto& entry : table) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("unknown " + std::string(kind) + " '" + std::string(name) + "'; there are: " + known);
}

}  // namespace

Record Method::make_record(const HemisphereGather& gather, const View& view) const {
  Record record;
  record.position = gather.position;
  record.normal = gather.frame.n;
  record.jet = estimator->estimate(gather);
  record.footprint = metric->measure(record.jet, view, settings);
  record.footprint.order = estimator->gradients ? 1 : 0;
  return record;
}

void Method::settle(const Settling& settling, std::span<const std::uint32_t> fresh) const {
  if (metric->settle && !fresh.empty()) metric->settle(settling, fresh, settings);
}

std::span<const Estimator> estimators() { return estimator_table; }
std::span<const Metric> metrics() { return metric_table; }
std::span<const Method> methods() { return method_table; }

Method find_method(std::string_view name) { return find(method_table, name, "method"); }
const Estimator& find_estimator(std::string_view name) { return find(estimator_table, name, "estimator"); }
const Metric& find_metric(std::string_view name) { return find(metric_table, name, "metric"); }

float threshold(const Metric& metric, double error) {
  return std::min(greatest_threshold, metric.a_per_root_error * static_cast<float>(std::sqrt(error)));
}

void check_combination(const Method& method) {
  if (!method.caches()) return;
  const auto pair = [&] {
    return "metric '" + std::string(method.metric->name) + "' and estimator '" + std::string(method.estimator->name) +
           "': ";
  };
  if (method.settings.bounds.gradient && !method.estimator->gradients)
    throw UsageError(pair() + "the bound by the gradient needs a gradient, which this estimator does not give");
  if (!method.metric->bounded && method.settings.bounds != RadiusBounds{})
    throw UsageError(pair() + "this metric heeds no bounds on the radius; 'bounded-split-sphere' does");
}

}  // namespace isophote
