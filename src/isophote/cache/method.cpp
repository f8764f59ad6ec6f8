#include <algorithm>
#include <cmath>

#include "isophote/cache/catalogue.h"

namespace isophote {

Record Method::make_record(const HemisphereGather& gather, const View& view) const {
  return make_record(gather.position, gather.frame.n, estimator->estimate(gather), view);
}

Record Method::make_record(const Vec3& position, const Vec3& normal, const Jet<Rgb>& jet, const View& view) const {
  Record record;
  record.position = position;
  record.normal = normal;
  record.jet = jet;
  if (!leak_test) record.jet.distances.obstacles = {};
  record.footprint = metric->measure(record.jet, view, settings);
  if (settings.falloff) record.footprint.set_falloff(*settings.falloff);
  record.footprint.order = static_cast<std::uint8_t>(std::min(order, estimator->order));
  record.curvature_scale = Record::whole_curvature(jet.value);  // of which metrics that settle may leave less
  return record;
}

RadianceRecord Method::make_radiance_record(const HemisphereGather& gather, int bands, const View& view) const {
  RadianceRecord record;
  record.position = gather.position;
  record.normal = gather.frame.n;
  record.jet = glossy.estimator->estimate(gather, glossy.basis, bands);
  if (!leak_test) record.jet.distances.obstacles = {};
  record.footprint = glossy.metric->measure_radiance(record.jet, view, glossy.settings);
  if (glossy.settings.falloff) record.footprint.set_falloff(*glossy.settings.falloff);
  const float by_bands = std::min(std::pow(9.0f / static_cast<float>(bands), glossy.band_power), 1 / glossy.settings.a);
  if (by_bands != 1) {
    Footprint& f = record.footprint;  // bounds are for the radius after all, so that they come last
    f.resize((glossy.metric->scale ? f.unscaled * glossy.metric->scale(glossy.settings) : f.radius) * by_bands);
    f.unscaled *= by_bands;
  }
  record.footprint.order = static_cast<std::uint8_t>(std::min(order, glossy.estimator->order));
  return record;
}

double Method::error() const { return std::pow(settings.a / metric->a_factor, 1 / metric->a_power); }

float Method::noise() const {
  // A value is read from a few records, whose errors average out in part, and of the mean of their size; the more
  // where each is fitted to many.
  const double of_error = regress ? 2.8 : 1.4;
  return static_cast<float>(of_error * error());
}

void Method::settle(const Settling& settling, std::span<const std::uint32_t> fresh) const {
  if (metric->settle && !fresh.empty()) metric->settle(settling, fresh, settings);
}

void Method::settle(const SettlingOf<RadianceRecord>& settling, std::span<const std::uint32_t> fresh) const {
  if (glossy.metric->settle_radiance && !fresh.empty())
    glossy.metric->settle_radiance(settling, fresh, glossy.settings);
}

ErrorModel Method::error_model() const {
  return {.by_hessian = estimator->order > 1,
          .threshold = settings.a,
          .scale = metric->scale ? metric->scale(settings) : 1,
          .factor = metric->a_factor,
          .power = metric->a_power};
}

}  // namespace isophote
