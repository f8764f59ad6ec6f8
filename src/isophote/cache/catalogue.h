#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/volume_radiance.h"
#include "isophote/validity/neighbour_index.h"
#include "isophote/validity/predicted_error.h"
#include "isophote/validity/radius_bounds.h"

namespace isophote {

/// What a metric is told besides the jet and the view.
struct MetricSettings {
  float a = 0.2f;  ///< the threshold: the smaller, the more records
  RadiusBounds bounds;
  float aspect = 1;                  ///< of ellipses, at most; 1: disks
  std::optional<Falloff> falloff{};  ///< another than the metric's
};

/// An estimator of `derivatives/`: what the illumination does around a record.
struct Estimator {
  std::string_view name, paper, gives;
  int order;  ///< 0: the value; 1: gradients too; 2: and the Hessian
  Jet<Rgb> (*estimate)(const HemisphereGather&);
  bool gradient_error = false;  ///< says how sure its gradient is, which regression weighs it by
};

/// An estimator of incident radiance as a function of direction.
struct RadianceEstimator {
  std::string_view name, paper, gives;
  int order;  ///< 0: the value; 1: its translational gradient too
  RadianceJet (*estimate)(const HemisphereGather&, Basis basis, int bands);
};

/// A metric of `validity/`: how far that can be trusted, and what records do to each other.
struct Metric {
  std::string_view name{}, paper{};
  bool bounded = false;             ///< heeds MetricSettings::bounds but
  bool by_gradient = false;         ///< that by the gradient
  bool elliptical = false;          ///< heeds MetricSettings::aspect
  int needs = 0;                    ///< order of the estimator at least; of 2 it also wants View::pilot
  float a_factor = 1, a_power = 1;  ///< a = factor * error^power aims at a wanted mean relative error
  Footprint (*measure)(const Jet<Rgb>&, const View&, const MetricSettings&) = nullptr;
  void (*settle)(const Settling&, std::span<const std::uint32_t> fresh,
                 const MetricSettings&) = nullptr;  ///< null: nothing
  /// The radius that the metric alone gives, over the unscaled one; null: they are the same.
  float (*scale)(const MetricSettings&) = nullptr;
  /// The same two for records of incident radiance; null: the metric is for irradiance alone.
  Footprint (*measure_radiance)(const RadianceJet&, const View&, const MetricSettings&) = nullptr;
  void (*settle_radiance)(const SettlingOf<RadianceRecord>&, std::span<const std::uint32_t> fresh,
                          const MetricSettings&) = nullptr;
};

/// An estimator of the radiance that arrives in media.
struct VolumeEstimator {
  std::string_view name{}, paper{}, gives{};
  int order = 0;                ///< 1: the gradient; 2: and the Hessian
  bool sums = false;            ///< and the magnitudes of the samples' gradients: VolumeJet::gradient_sum
  bool sees_occluders = false;  ///< and its gradient holds what moves behind their edges
  VolumeJet (*estimate)(const SphereGather&, VolumePart, int bands) = nullptr;
};

/// A metric of such records.
struct VolumeMetric {
  std::string_view name{}, paper{};
  bool bounded = false;             ///< heeds MetricSettings::bounds but
  bool by_gradient = false;         ///< that by the gradient
  bool elliptical = false;          ///< heeds MetricSettings::aspect, of ellipsoids
  bool needs_sums = false;          ///< of the estimator
  int needs = 0;                    ///< order of the estimator at least
  float a_factor = 1, a_power = 1;  ///< as Metric's
  Footprint (*measure)(const VolumeJet&, const View&, const MetricSettings&) = nullptr;
  float (*scale)(const MetricSettings&) = nullptr;  ///< as Metric's
};

/// What gather rays read where they hit.
enum class Secondary : std::uint8_t {
  off,        ///< nothing: paths go on
  cells,      ///< means over the cells of a grid: irradiance_cells.h
  records,    ///< the records so far, and cells where they do not cover
  automatic,  ///< records or nothing, whichever a pilot finds to be better
};

/// What glossy lobes take the indirect light from that they reflect.
enum class Glossy : std::uint8_t {
  rays,       ///< a ray of the lobe, followed
  cache,      ///< records of incident radiance, from the least roughness that there are tables for
  automatic,  ///< those where their bands hold the lobe, else a ray
};

/// How incident radiance is cached.
struct GlossyMethod {
  Glossy from = Glossy::rays;
  const RadianceEstimator* estimator = nullptr;
  const Metric* metric = nullptr;
  MetricSettings settings{};
  Basis basis = Basis::hemispherical;
  /// The more bands, the faster coefficients change from place to place: a record of n has the metric's radius times
  /// (9 / n)^this, at most what the threshold 1 gives. 0: all have the metric's, as published.
  float band_power = 0;
  /// What records may differ by where they overlap, of what is reflected, before they shrink (adapt_radii.h); 0: by
  /// anything.
  float contrast = 0;
  bool window = false;  ///< are lobes windowed? (lobe.h)

  bool caches() const { return from != Glossy::rays; }
};

/// What media take the light from that they scatter, but for that of emitters which are sampled directly.
enum class InScattering : std::uint8_t {
  paths,  ///< a path from each place that is looked at
  cache,  ///< records of the radiance that arrives
};

/// How radiance in media is cached.
struct VolumeMethod {
  InScattering from = InScattering::paths;
  const VolumeEstimator* estimator = nullptr;
  const VolumeMetric* metric = nullptr;
  MetricSettings settings{};
  bool logarithmic = false;  ///< are records interpolated in logarithms? (Footprint)

  bool caches() const { return from != InScattering::paths; }
};

/// A named combination. `estimator` is null for the path-traced reference, which caches nothing.
struct Method {
  std::string name;
  std::string_view paper, summary;
  const Estimator* estimator = nullptr;
  const Metric* metric = nullptr;
  MetricSettings settings{};
  int order = 0;  ///< of extrapolation, at most what the estimator gives
  Secondary secondary = Secondary::off;
  bool adaptive = false;   ///< each record gathers as many rays as its own noise needs
  bool leak_test = false;  ///< a record keeps what it saw near: see `serving_error`
  bool regress = false;    ///< records are fitted to their neighbours at the end: regression.h
  GlossyMethod glossy{};
  VolumeMethod volume{};

  bool caches() const { return estimator != nullptr; }
  /// The mean relative error that the threshold aims at; and the standard error of a record, relative to its value,
  /// that goes with it where rays adapt.
  double error() const;
  float noise() const;
  Record make_record(const HemisphereGather& gather, const View& view) const;
  /// Where what the estimator says is known already.
  Record make_record(const Vec3& position, const Vec3& normal, const Jet<Rgb>& jet, const View& view) const;
  void settle(const Settling& settling, std::span<const std::uint32_t> fresh) const;
  /// A record of incident radiance in so many bands, by the glossy method.
  RadianceRecord make_radiance_record(const HemisphereGather& gather, int bands, const View& view) const;
  void settle(const SettlingOf<RadianceRecord>& settling, std::span<const std::uint32_t> fresh) const;
  /// A record of what the volume method's estimator says of a place, in media that hold it as their bits say.
  VolumeRecord make_volume_record(const Vec3& position, VolumeJet jet, std::uint32_t media, const View& view) const;
  void settle(const SettlingOf<VolumeRecord>& settling, std::span<const std::uint32_t> fresh) const;
  /// What `predicted_error` wants to know of records made by this method.
  ErrorModel error_model() const;
};

std::string_view name_of(Secondary secondary);
std::string_view name_of(Glossy glossy);
std::string_view name_of(Basis basis);
std::string_view name_of(InScattering from);

std::span<const Estimator> estimators();
std::span<const RadianceEstimator> radiance_estimators();
std::span<const Metric> metrics();
std::span<const VolumeEstimator> volume_estimators();
std::span<const VolumeMetric> volume_metrics();
std::span<const Method> methods();

/// Throw UsageError with the known names where there is none of this name.
Method find_method(std::string_view name);
const Estimator& find_estimator(std::string_view name);
const RadianceEstimator& find_radiance_estimator(std::string_view name);
const Metric& find_metric(std::string_view name);
const VolumeEstimator& find_volume_estimator(std::string_view name);
const VolumeMetric& find_volume_metric(std::string_view name);

/// Thresholds lie between these: with a greater one, a footprint would be larger than the distances it was derived
/// from.
inline constexpr float least_threshold = 1e-6f, greatest_threshold = 1;
/// The threshold by which a metric aims at a wanted mean relative error.
float threshold(const Metric& metric, double error);
float threshold(const VolumeMetric& metric, double error);

/// Throws UsageError, naming both sides, where the metric or its bounds need what the estimator does not give, or where
/// bounds or an aspect are set that the metric does not heed. Called before any ray is shot.
void check_combination(const Method& method);
void check_combination(const VolumeMethod& method);

}  // namespace isophote
