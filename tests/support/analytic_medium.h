#pragma once

#include <cmath>
#include <numbers>

#include "isophote/core/sym3.h"
#include "isophote/core/vec.h"
#include "isophote/harmonics/quadrature.h"

namespace isophote::test {

/// A medium whose extinction sigma_t (1/m), its derivatives and its optical depths are closed forms.
class AnalyticMedium {
 public:
  enum class Kind { none, homogeneous, fog, blob };

  explicit AnalyticMedium(Kind kind) : kind_(kind) {}

  double extinction(const Vec3d& p) const {
    switch (kind_) {
      case Kind::none:
        return 0;
      case Kind::homogeneous:
        return constant;
      case Kind::fog:
        return fog * std::exp(-p.z / fog_height);
      default:
        return blob_base + bump(p);
    }
  }
  Vec3d slope(const Vec3d& p) const {
    if (kind_ == Kind::fog) return {0, 0, -extinction(p) / fog_height};
    if (kind_ == Kind::blob) return (p - blob_centre()) * (-bump(p) / (blob_width * blob_width));
    return {};
  }
  Sym3d curvature(const Vec3d& p) const {
    if (kind_ == Kind::fog) return Sym3d::outer({0, 0, 1}, extinction(p) / (fog_height * fog_height));
    if (kind_ != Kind::blob) return {};
    const double width2 = blob_width * blob_width;
    return (Sym3d::outer(p - blob_centre(), 1 / width2) + Sym3d::scaled_identity(-1)) * (bump(p) / width2);
  }

  /// From x over t along w.
  double optical_depth(const Vec3d& x, const Vec3d& w, double t) const {
    switch (kind_) {
      case Kind::none:
        return 0;
      case Kind::homogeneous:
        return constant * t;
      case Kind::fog: {
        const double k = w.z / fog_height;
        return extinction(x) * (std::abs(k * t) < 1e-6 ? t * (1 - k * t / 2) : -std::expm1(-k * t) / k);
      }
      default: {
        const Vec3d d = x - blob_centre();
        const double b = dot(d, w), s = blob_width * std::numbers::sqrt2;
        const double peak = blob * std::exp(-(dot(d, d) - b * b) / (s * s)) * s * std::sqrt(std::numbers::pi) / 2;
        return blob_base * t + peak * (std::erf((t + b) / s) - std::erf(b / s));
      }
    }
  }
  double transmittance(const Vec3d& x, const Vec3d& w, double t) const { return std::exp(-optical_depth(x, w, t)); }

  /// Of the logarithm of transmittance from x to x + t w, as x moves and the other end stays.
  Vec3d log_gradient(const Vec3d& x, const Vec3d& w, double t) const {
    Vec3d sum;
    along(t, [&](double u, double weight) { sum += slope(x + w * (u * t)) * ((1 - u) * weight); });
    return w * extinction(x) - (sum - w * dot(sum, w)) * t;
  }
  /// And its second derivatives.
  Sym3d log_hessian(const Vec3d& x, const Vec3d& w, double t) const {
    Vec3d first;
    Sym3d second;
    along(t, [&](double u, double weight) {
      first += slope(x + w * (u * t)) * ((1 - u) * weight);
      second += curvature(x + w * (u * t)) * ((1 - u) * (1 - u) * weight);
    });
    const double mean = optical_depth(x, w, t) / t;
    return Sym3d::across(w) * (-mean / t) + Sym3d::symmetric_outer(w, first, 1) + second * -t;
  }

 private:
  static constexpr double constant = 0.5, fog = 0.9, fog_height = 0.8, blob = 1.5, blob_width = 0.35, blob_base = 0.1;
  static Vec3d blob_centre() { return {0.1, 0.2, 0.8}; }
  double bump(const Vec3d& p) const {
    return blob * std::exp(-length_squared(p - blob_centre()) / (2 * blob_width * blob_width));
  }

  /// Quadrature over u in [0, 1] of what varies as extinction does over a distance t.
  template <class F>
  void along(double t, F&& f) const {
    if (kind_ == Kind::none || kind_ == Kind::homogeneous) return;
    const int pieces = kind_ == Kind::fog ? 1 : 1 + static_cast<int>(t / 0.8);
    for (int i = 0; i < pieces; ++i)
      GaussRule<8>::get().integrate(static_cast<double>(i) / pieces, (i + 1.0) / pieces, f);
  }

  Kind kind_;
};

}  // namespace isophote::test
