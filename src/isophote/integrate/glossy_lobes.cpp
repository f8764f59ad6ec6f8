#include "isophote/integrate/glossy_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isophote/harmonics/quadrature.h"
#include "isophote/scene/ggx.h"

namespace isophote {
namespace {

// Roots of alpha and of the cosine are spaced evenly: lobes change most where both are small.
constexpr int roughnesses = 20, cosines = 32;
const float least_root = std::sqrt(GlossyLobes::least_alpha);

float root_of_alpha(float at) { return least_root + (1 - least_root) * at / (roughnesses - 1); }
float root_of_cosine(float at) { return std::max(0.1f, at) / (cosines - 1); }

/// Incident directions on half the hemisphere, for lobes are even in azimuth, with what it takes to project there.
class Directions {
 public:
  static constexpr int polar = 64, azimuthal = 64;

  explicit Directions(Basis basis) : values_(static_cast<std::size_t>(polar) * polar_count(most_order)) {
    std::array<double, harmonics_count(most_order)> all;
    const auto& rule = GaussRule<polar>::get();
    for (int i = 0; i < polar; ++i) {
      // Denser towards the horizon, where the cosine is 0 and hemispherical functions have a root: z = t^2.
      const double t = (1 + rule.nodes[i]) / 2;
      z_[i] = t * t, weights_[i] = rule.weights[i] / 2 * 2 * t * (2 * std::numbers::pi / azimuthal);
      evaluate_harmonics(basis, most_order, {std::sqrt(1 - z_[i] * z_[i]), 0, z_[i]}, all);
      for (int l = 0; l < most_order; ++l)
        for (int m = 0; m <= l; ++m)
          values_[i * polar_count(most_order) + polar_index(l, m)] = all[harmonic_index(l, m)];
    }
    for (int k = 0; k < azimuthal; ++k)
      for (int m = 0; m < most_order; ++m) cosines_[k * most_order + m] = std::cos(m * azimuth(k));
  }

  static double azimuth(int k) { return std::numbers::pi * (k + 0.5) / azimuthal; }
  double z(int i) const { return z_[i]; }
  double weight(int i) const { return weights_[i]; }
  double value(int i, int l, int m) const { return values_[i * polar_count(most_order) + polar_index(l, m)]; }
  double cosine(int k, int m) const { return cosines_[k * most_order + m]; }

 private:
  std::array<double, polar> z_, weights_;
  std::vector<double> values_;
  std::array<double, azimuthal * most_order> cosines_;
};

/// The lobe for f0 and that for f90.
struct Pair {
  double f0 = 0, f90 = 0;
  Pair& operator+=(const Pair& o) { return f0 += o.f0, f90 += o.f90, *this; }
  Pair operator*(double s) const { return {f0 * s, f90 * s}; }
};

Pair lobe_at(const Vec3d& o, const Vec3d& i, double alpha) {
  const Vec3d h = normalize(o + i);
  const double f = ggx::distribution(h, alpha) * ggx::masking_shadowing(o, i, alpha) / (4 * o.z);
  const double across = 1 - dot(o, h), squared = across * across, grazing = squared * squared * across;
  return {f * (1 - grazing), f * grazing};
}

}  // namespace

GlossyLobes::GlossyLobes(Basis basis)
    : nodes_(roughnesses * cosines), truncation_((most_order + 1) * nodes_.size(), 1.0f) {
  const Directions directions(basis);
  for (int r = 0; r < roughnesses; ++r)
    for (int c = 0; c < cosines; ++c) {
      const double alpha = std::pow(root_of_alpha(static_cast<float>(r)), 2),
                   cos_o = std::pow(root_of_cosine(static_cast<float>(c)), 2);
      const Vec3d o{std::sqrt(1 - cos_o * cos_o), 0, cos_o};
      std::array<Pair, polar_count(most_order)> sums{};
      double whole = 0;
      for (int i = 0; i < Directions::polar; ++i) {
        const double z = directions.z(i), across = std::sqrt(1 - z * z);
        std::array<Pair, most_order> by_azimuth{};
        for (int k = 0; k < Directions::azimuthal; ++k) {
          const double phi = Directions::azimuth(k);
          const Pair f = lobe_at(o, {across * std::cos(phi), across * std::sin(phi), z}, alpha);
          whole += f.f0 * f.f0 * directions.weight(i);
          for (int m = 0; m < most_order; ++m) by_azimuth[m] += f * directions.cosine(k, m);
        }
        for (int l = 0; l < most_order; ++l)
          for (int m = 0; m <= l; ++m)
            sums[polar_index(l, m)] += by_azimuth[m] * (directions.weight(i) * directions.value(i, l, m));
      }
      const std::size_t at = r * cosines + c;
      Node& node = nodes_[at];
      double held = 0;
      for (int l = 0; l < most_order; ++l) {
        for (int m = 0; m <= l; ++m) {
          const Pair& sum = sums[polar_index(l, m)];
          node.by_f0[polar_index(l, m)] = static_cast<float>(sum.f0);
          node.by_f90[polar_index(l, m)] = static_cast<float>(sum.f90);
          held += sum.f0 * sum.f0;
        }
        truncation_[(l + 1) * nodes_.size() + at] = static_cast<float>(std::sqrt(std::max(0.0, 1 - held / whole)));
      }
    }
}

GlossyLobes::Place::Place(float alpha, float cos_o) {
  const float a = (std::sqrt(std::clamp(alpha, least_alpha, 1.0f)) - least_root) / (1 - least_root) * (roughnesses - 1);
  const float c = std::sqrt(std::clamp(cos_o, 0.0f, 1.0f)) * (cosines - 1);
  const int i = std::clamp(static_cast<int>(a), 0, roughnesses - 2), j = std::min(static_cast<int>(c), cosines - 2);
  const float s = a - static_cast<float>(i), t = c - static_cast<float>(j);
  const int first = i * cosines + j;
  at = {first, first + 1, first + cosines, first + cosines + 1};
  weights = {(1 - s) * (1 - t), (1 - s) * t, s * (1 - t), s * t};
}

void GlossyLobes::set(Lobe& lobe, float alpha, float cos_o, const Rgb& f0, const Rgb& f90) const {
  const Place place(alpha, cos_o);
  const auto& [a, b, c, d] = place.at;
  const auto& [wa, wb, wc, wd] = place.weights;
  const Node &na = nodes_[a], &nb = nodes_[b], &nc = nodes_[c], &nd = nodes_[d];
  for (int i = 0; i < polar_count(lobe.order); ++i) {
    const float by_f0 = wa * na.by_f0[i] + wb * nb.by_f0[i] + wc * nc.by_f0[i] + wd * nd.by_f0[i];
    const float by_f90 = wa * na.by_f90[i] + wb * nb.by_f90[i] + wc * nc.by_f90[i] + wd * nd.by_f90[i];
    lobe.coefficients[i] = f0 * by_f0 + f90 * by_f90;
  }
}

GlossyLobes::Truncation GlossyLobes::truncation(float alpha, float cos_o) const { return {*this, Place(alpha, cos_o)}; }

float GlossyLobes::Truncation::operator[](int order) const {
  const float* all = &lobes_->truncation_[order * lobes_->nodes_.size()];
  float sum = 0;
  for (int i = 0; i < 4; ++i) sum += place_.weights[i] * all[place_.at[i]];
  return sum;
}

void SurfaceLobe::operator()(Lobe& lobe, float cosine) const {
  const Rgb there = specular_albedo(bsdf_, cosine);
  const auto ratio = [&](int c) { return there[c] > 0 ? albedo_[c] / there[c] : 1; };
  const Rgb scale{ratio(0), ratio(1), ratio(2)};
  lobes_.set(lobe, bsdf_.alpha, cosine, bsdf_.f0 * scale, scale * bsdf_.f90);
  if (window_) apply_window(lobe);
}

const GlossyLobes& glossy_lobes(Basis basis) {
  if (basis == Basis::spherical) {
    static const GlossyLobes spherical(Basis::spherical);
    return spherical;
  }
  static const GlossyLobes hemispherical(Basis::hemispherical);
  return hemispherical;
}

}  // namespace isophote
