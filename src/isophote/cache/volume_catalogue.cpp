#include <cmath>
#include <utility>

#include "isophote/cache/catalogue_rows.h"
#include "isophote/derivatives/jarosz_2008a.h"
#include "isophote/derivatives/marco_2018.h"
#include "isophote/derivatives/moving_walls.h"
#include "isophote/validity/relative_change.h"
#include "isophote/validity/settle.h"
#include "isophote/validity/uniform.h"
#include "isophote/validity/volume_error.h"

// The catalogue's tables of methods for light in media.
namespace isophote {
namespace {

constexpr VolumeEstimator estimator_table[] = {
    {.name = "volume", .gives = "value, gradients of samples", .sums = true, .estimate = volume_radiance},
    {.name = "volume-unaware",
     .paper = "[Jarosz 2008a]",
     .gives = "value, gradient unaware of occlusion, gradients of samples",
     .order = 1,
     .sums = true,
     .estimate = jarosz_2008a},
    {.name = "volume-walls",
     .gives = "value, gradient, gradients of samples",
     .order = 1,
     .sums = true,
     .sees_occluders = true,
     .estimate = [](const SphereGather& g, VolumePart part, int bands) { return moving_walls(g, part, bands); }},
    {.name = "volume-triangulated",
     .paper = "[Marco 2018]",
     .gives = "value, gradient, Hessian, gradients of samples",
     .order = 2,
     .sums = true,
     .sees_occluders = true,
     .estimate = marco_2018},
};

float as_threshold(const MetricSettings& s) { return s.a; }

constexpr VolumeMetric metric_table[] = {
    // Chosen by hand, and above 1: a sample's gradient is mostly along it, what of its light comes from near being as
    // 1 / r^2, and most of that cancels between directions.
    {.name = "relative-change",
     .paper = "[Jarosz 2008a]",
     .bounded = true,
     .by_gradient = true,
     .needs_sums = true,
     .a_factor = 11.5f,
     .a_power = 0.5f,
     .measure = [](const VolumeJet& jet, const View& view,
                   const MetricSettings& s) { return relative_change(jet, view, s.a, s.bounds); },
     .scale = as_threshold},
    {.name = "volume-error",
     .paper = "[Marco 2018]",
     .bounded = true,
     .by_gradient = true,
     .elliptical = true,
     .needs = 2,
     .measure = [](const VolumeJet& jet, const View& view,
                   const MetricSettings& s) { return volume_error(jet, view, s.a, s.bounds, s.aspect); }},
    {.name = "uniform",
     .a_factor = 1.4f,
     .a_power = 0.5f,
     .measure = [](const VolumeJet&, const View& view,
                   const MetricSettings& s) { return uniform_in_media(view, s.a); }},
};

}  // namespace

std::string_view name_of(InScattering from) { return from == InScattering::paths ? "paths" : "cache"; }

std::span<const VolumeEstimator> volume_estimators() { return estimator_table; }
std::span<const VolumeMetric> volume_metrics() { return metric_table; }

const VolumeEstimator& find_volume_estimator(std::string_view name) {
  return find_row(estimator_table, name, "estimator of radiance in media");
}
const VolumeMetric& find_volume_metric(std::string_view name) {
  return find_row(metric_table, name, "metric of records in media");
}

float threshold(const VolumeMetric& metric, double error) {
  return metric.a_factor * std::pow(static_cast<float>(error), metric.a_power);
}

VolumeRecord Method::make_volume_record(const Vec3& position, VolumeJet jet, std::uint32_t media,
                                        const View& view) const {
  VolumeRecord record;
  record.position = position;
  record.media = media;
  record.jet = std::move(jet);
  record.footprint = volume.metric->measure(record.jet, view, volume.settings);
  if (volume.settings.falloff) record.footprint.falloff = *volume.settings.falloff;
  record.footprint.order = static_cast<std::uint8_t>(std::min({order, volume.estimator->order, 1}));
  record.footprint.logarithmic = volume.logarithmic;
  return record;
}

void Method::settle(const SettlingOf<VolumeRecord>& settling, std::span<const std::uint32_t> fresh) const {
  const VolumeMetric& m = *volume.metric;
  const MetricSettings& s = volume.settings;
  if (!fresh.empty())
    isophote::settle(settling, fresh, {.scale = m.scale ? m.scale(s) : 1, .slope = s.bounds.neighbours});
}

void check_combination(const VolumeMethod& method) {
  const VolumeMetric& m = *method.metric;
  const VolumeEstimator& e = *method.estimator;
  const auto refuse = [&](const char* why) {
    throw UsageError("metric '" + std::string(m.name) + "' and estimator '" + std::string(e.name) + "': " + why);
  };
  if (m.needs_sums && !e.sums) refuse("this metric needs the gradients of samples, which this estimator does not give");
  if (e.order < m.needs) refuse("this metric needs a Hessian, which this estimator does not give");
  if (method.settings.bounds.gradient && e.order == 0)
    refuse("the bound by the gradient needs a gradient, which this estimator does not give");
  if (!m.bounded && method.settings.bounds != RadiusBounds{})
    refuse("this metric heeds no bounds on the radius; 'volume-error' does");
  if (!m.by_gradient && method.settings.bounds.gradient)
    refuse("this metric heeds no bound by the gradient; 'relative-change' and 'volume-error' do");
  if (!m.elliptical && method.settings.aspect > 1)
    refuse("this metric's footprints are balls; those of 'volume-error' may be ellipsoids");
}

}  // namespace isophote
