#include "isophote/cache/volume_cache.h"

#include <algorithm>

#include "isophote/core/check.h"
#include "isophote/core/ray.h"

namespace isophote {
namespace {

/// Of the mean over all records: below it a channel's logarithm would say more of noise than of light.
constexpr double least_of_mean = 1e-6;
constexpr float most_exponent = 2;

/// One channel of a weighted mean over records: of the logarithms where those are counted, of the values else. The two
/// are averaged by their weights, so that nothing jumps where a record that is not in logarithms comes in.
class Mean {
 public:
  /// Of value * exp(exponent).
  void add_logarithm(double weight, double value, float exponent) {
    if (!(log_weights_ > 0)) unit_ = value;
    logarithms_ += weight * (std::log(value / unit_) + static_cast<double>(exponent));
    log_weights_ += weight;
  }
  void add(double weight, double value) { values_ += weight * value, weights_ += weight; }
  float get() const {
    const double geometric = log_weights_ > 0 ? log_weights_ * unit_ * std::exp(logarithms_ / log_weights_) : 0;
    return static_cast<float>(std::max(0.0, (geometric + values_) / (log_weights_ + weights_)));
  }

 private:
  double unit_ = 1;  // the first value, so that no unit of light is better than another
  double logarithms_ = 0, log_weights_ = 0, values_ = 0, weights_ = 0;
};

/// Do so many bands hold the phase function but for what may be missing?
bool is_held(float g, int bands) {
  // Band l holds (2 l + 1) g^2l of the square, which from n on sums up to x^n ((2 n + 1) / (1 - x) + 2 x / (1 - x)^2).
  constexpr double missing = 0.05;
  const double x = static_cast<double>(g) * static_cast<double>(g), rest = 1 / (1 - x);
  const auto from = [&](int n) { return std::pow(x, n) * ((2 * n + 1) * rest + 2 * x * rest * rest); };
  return from(bands) <= missing * missing * from(0);
}

}  // namespace

PhaseLobe phase_lobe(float g, const Vec3& wo, int order) {
  ISOPHOTE_CHECK(order, <=, most_volume_bands);
  std::array<double, harmonics_count(most_volume_bands)> values;
  evaluate_harmonics(Basis::spherical, order, -Vec3d(wo), values);
  PhaseLobe lobe{};
  double power = 1;  // g^l
  for (int l = 0; l < order; ++l, power *= static_cast<double>(g))
    for (int m = -l; m <= l; ++m) lobe[harmonic_index(l, m)] = static_cast<float>(power * values[harmonic_index(l, m)]);
  return lobe;
}

int bands_for(float g) {
  int bands = 1;
  while (bands < most_volume_bands && !is_held(g, bands)) ++bands;
  return bands;
}

bool bands_hold(float g) { return is_held(g, most_volume_bands); }

float serving_error(const VolumeRecord& record, const VolumeQuery& query, VolumeOpenTest open) {
  if (record.media != query.media) return infinity;
  const Vec3 q = query.position - record.position;
  const float distance = quadratic_form(record.footprint.shape, q);
  if (!(distance < 1)) return infinity;
  if (record.jet.obstacles.before(q) && !open(record, query)) return infinity;
  return std::sqrt(distance);
}

Extrapolated extrapolate(const VolumeRecord& record, const Vec3& d, std::span<const float> lobe, int order) {
  const int count = harmonics_count(order);
  const Rgb* value = record.jet.value.data();
  Extrapolated sum;
  for (int i = 0; i < count; ++i) sum.value += value[i] * lobe[i];
  if (!record.has_slope()) return sum;
  const Gradient<Coefficients>& slope = record.jet.translational;
  const Rgb *x = slope.x.data(), *y = slope.y.data(), *z = slope.z.data();
  for (int i = 0; i < count; ++i) sum.change += (x[i] * d.x + y[i] * d.y + z[i] * d.z) * lobe[i];
  sum.change *= record.gradient_scale;
  return sum;
}

std::uint32_t VolumeCache::insert(VolumeRecord record) {
  ISOPHOTE_CHECK(record.jet.value.size(), >, 0u);
  sum_ += mean_over_directions(record.jet);
  return RecordStore::insert(std::move(record));
}

std::optional<Rgb> VolumeCache::scattered(const VolumeQuery& query, std::span<const float> lobe, int order,
                                          VolumeOpenTest open) const {
  const float least = static_cast<float>(least_of_mean * mean());
  std::array<Mean, 3> means;
  bool found = false;
  visit_serving(query, open, [&](std::uint32_t id, float, float weight) {
    const VolumeRecord& record = records()[id];
    if (!holds(record, order)) return;
    const Extrapolated s = extrapolate(record, query.position - record.position, lobe, order);
    for (int c = 0; c < 3; ++c) {
      const float value = s.value[c], change = s.change[c];
      if (record.footprint.logarithmic && value > least)
        means[c].add_logarithm(weight, value, std::clamp(change / value, -most_exponent, most_exponent));
      else
        means[c].add(weight, value + change);
    }
    found = found || weight > 0;
  });
  if (!found) return std::nullopt;
  return Rgb(means[0].get(), means[1].get(), means[2].get());
}

}  // namespace isophote
