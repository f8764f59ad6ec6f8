#pragma once

#include <span>
#include <string>
#include <string_view>

#include "isophote/derivatives/gather.h"
#include "isophote/validity/bounded_split_sphere.h"

namespace isophote {

/// What a metric is told besides the jet and the view.
struct MetricSettings {
  float a = 0.2f;  ///< the error at which a record's use ends; the smaller, the more records
  RadiusBounds bounds;
};

/// An estimator of `derivatives/`: what the illumination does around a record.
struct Estimator {
  std::string_view name, paper, gives;
  bool gradients;
  Jet<Rgb> (*estimate)(const HemisphereGather&);
};

/// A metric of `validity/`: how far that can be trusted, and what records do to each other.
struct Metric {
  std::string_view name, paper;
  bool bounded;            ///< heeds MetricSettings::bounds
  float a_per_root_error;  ///< a = this * sqrt(wanted error): fitted once to the Cornell box, see `bench/run asked`
  Footprint (*measure)(const Jet<Rgb>&, const View&, const MetricSettings&);
  void (*settle)(const Settling&, std::span<const std::uint32_t> fresh, const MetricSettings&);  ///< null: nothing
};

/// A named combination. `estimator` is null for the path-traced reference, which caches nothing.
struct Method {
  std::string name;
  std::string_view paper, summary;
  const Estimator* estimator = nullptr;
  const Metric* metric = nullptr;
  MetricSettings settings;
  bool secondary = false;  ///< gather rays read the cache where they hit

  bool caches() const { return estimator != nullptr; }
  Record make_record(const HemisphereGather& gather, const View& view) const;
  void settle(const Settling& settling, std::span<const std::uint32_t> fresh) const;
};

std::span<const Estimator> estimators();
std::span<const Metric> metrics();
std::span<const Method> methods();

/// Throw UsageError with the known names where there is none of this name.
Method find_method(std::string_view name);
const Estimator& find_estimator(std::string_view name);
const Metric& find_metric(std::string_view name);

/// Thresholds end here: a footprint with a greater one is larger than the distances it was derived from.
inline constexpr float greatest_threshold = 1;
/// The threshold by which a metric aims at a wanted mean relative error.
float threshold(const Metric& metric, double error);

/// Throws UsageError, naming both sides, where the metric or its bounds need what the estimator does not give, or where
/// bounds are set that the metric does not heed. Called before any ray is shot.
void check_combination(const Method& method);

}  // namespace isophote
