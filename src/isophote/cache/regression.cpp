#include "isophote/cache/regression.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "isophote/cache/parabola_fit.h"
#include "isophote/validity/tangent_axes.h"

namespace isophote {
namespace {

/// Radii that a neighbour may be away, of the smaller of the two.
constexpr float neighbour_radii = 4;
constexpr std::size_t fewest_neighbours = 3;
/// Standard errors, of luminance and relative to the neighbourhood's, by which a channel may move.
constexpr double most_errors = 3;

double square(double x) { return x * x; }

/// The mean of the absolute eigenvalues of a record's Hessian, of luminance.
double curvature(const Record& record) {
  const TangentAxes axes(Sym3d(record.jet.hessian), Vec3d(record.normal));
  return (std::abs(axes.greater) + std::abs(axes.lesser)) / 2;
}

/// What many records of a neighbourhood have in common.
struct Pooled {
  double spread = 0;  ///< variance of one ray's share, luminance squared
  double value = 0;   ///< luminance
};

/// Variance of a record's value.
double noise(const Pooled& pooled, const Record& record) {
  return pooled.spread / std::max(1.0, static_cast<double>(record.jet.rays));
}

/// The parabola about one record, in units of its radius. Each neighbour counts by its own noise, pooled, for single
/// variances go with the values that they belong to and would draw the fit down; and by what its curvature leaves
/// unsaid at its distance.
class Parabola {
 public:
  Parabola(const Record& record, const Pooled& pooled, double distrust)
      : frame_(Vec3d(record.normal)),
        normal_(record.normal),
        radius_(record.footprint.radius),
        curvature_(curvature(record)),
        pooled_(pooled),
        distrust_(distrust),
        least_(square(1e-4 * pooled.value)) {
    // Of the bends themselves nothing is known but how large they may be.
    const double prior = 1 / (square(2 * curvature_ * radius_ * radius_) + least_);
    for (int i = 3; i < ParabolaFit::unknowns; ++i) {
      ParabolaFit::Row row{};
      row[i] = 1;
      fit_.add(row, {}, prior);
    }
  }

  void add(const Record& other, const Vec3& offset, float distance) {
    const Jet<Rgb>& jet = other.jet;
    const Vec3d q(offset);
    const double x = dot(q, frame_.u) / radius_, y = dot(q, frame_.v) / radius_;
    const double bend = (curvature_ + curvature(other)) / 2 * distrust_ * std::min(1.0, distance / (3 * radius_));
    const Rgb turned = jet.value + jet.rotational.dot(cross(other.normal, normal_));
    fit_.add({1, x, y, x * x / 2, x * y, y * y / 2}, Rgbd(turned),
             1 / (least_ + noise(pooled_, other) + square(bend * distance * distance / 2)));
    const double weight = 1 / (least_ + square(radius_) * (square(jet.gradient_error) + square(bend * distance)));
    const auto along = [&](const Vec3d& axis) { return Rgbd(jet.translational.dot(Vec3(axis))) * radius_; };
    fit_.add({0, 1, 0, x, y, 0}, along(frame_.u), weight);
    fit_.add({0, 0, 1, 0, x, y}, along(frame_.v), weight);
  }

  /// False where the records do not decide, or say something beyond numbers.
  bool solve() {
    if (!fit_.solve()) return false;
    const Gradient<Rgb> g = gradient();
    return is_finite(Rgb(fit_[0])) && is_finite(g.x) && is_finite(g.y) && is_finite(g.z);
  }
  const Rgbd& value() const { return fit_[0]; }
  double standard_error() const { return std::sqrt(fit_.variance()); }
  double least() const { return least_; }
  Gradient<Rgb> gradient() const {
    const Rgbd u = fit_[1] / radius_, v = fit_[2] / radius_;
    const Framed& f = frame_;
    return {Rgb(u * f.u.x + v * f.v.x), Rgb(u * f.u.y + v * f.v.y), Rgb(u * f.u.z + v * f.v.z)};
  }

 private:
  Framed frame_;
  Vec3 normal_;
  double radius_, curvature_;
  Pooled pooled_;
  double distrust_, least_;
  ParabolaFit fit_;
};

template <class Neighbours>
Pooled pooled(const Neighbours& neighbours) {
  Pooled sum;
  for (const auto& n : neighbours) {
    sum.spread += square(n.record->jet.standard_error) * n.record->jet.rays;
    sum.value += luminance(n.record->jet.value);
  }
  const auto count = static_cast<double>(neighbours.size());
  return {sum.spread / count, sum.value / count};
}

/// A record after its fit, by weighted least squares, and the weight that its own value has in the new one.
struct Fit {
  Record record;
  double own = 1;
};

/// None where the neighbours do not decide.
template <class Neighbours>
std::optional<Fit> fit(const Record& record, const Neighbours& neighbours, const Pooled& pooled, double distrust) {
  Parabola parabola(record, pooled, distrust);
  for (const auto& n : neighbours) parabola.add(*n.record, n.offset, n.distance);
  if (!parabola.solve()) return std::nullopt;
  const double variance = noise(pooled, record), error = std::sqrt(variance);
  Fit result{record, square(parabola.standard_error()) / (parabola.least() + variance)};
  Jet<Rgb>& jet = result.record.jet;
  for (int c = 0; c < 3; ++c) {
    const double before = jet.value[c], room = most_errors * error * std::max(1.0, before / pooled.value);
    jet.value[c] = static_cast<float>(std::max(0.0, std::clamp(parabola.value()[c], before - room, before + room)));
  }
  jet.translational = parabola.gradient();
  jet.standard_error = static_cast<float>(std::min(error, parabola.standard_error()));
  return result;
}

}  // namespace

Regression::Regression(const RecordCache& cache) : neighbours_(cache, neighbour_radii) {}

Regression::Risks Regression::risks(std::uint32_t id, OpenTest open) const {
  const Record& record = neighbours_.records()[id];
  const auto around = neighbours_.around(record, open);
  if (around.size() < fewest_neighbours) return {};
  const Pooled all = pooled(around);
  if (!(all.value > 0)) return {};
  const double variance = noise(all, record);
  Risks risks{};
  for (std::size_t i = 0; i < distrusts.size(); ++i) {
    const std::optional<Fit> fitted = fit(record, around, all, distrusts[i]);
    if (!fitted) return {};
    const double moved = luminance(Rgbd(fitted->record.jet.value)) - luminance(Rgbd(record.jet.value));
    risks[i] = (square(moved) - variance + 2 * fitted->own * variance) / square(all.value);
  }
  return risks;
}

Record Regression::fitted(std::uint32_t id, double distrust, OpenTest open) const {
  const Record& record = neighbours_.records()[id];
  const auto around = neighbours_.around(record, open);
  if (around.size() < fewest_neighbours) return record;
  const Pooled all = pooled(around);
  if (!(all.value > 0)) return record;
  const std::optional<Fit> fitted = fit(record, around, all, distrust);
  return fitted ? fitted->record : record;
}

}  // namespace isophote
