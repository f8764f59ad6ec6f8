#pragma once

#include "support/analytic_medium.h"

// What a light that is a place or a direction has scattered once at x towards wo, per unit of sigma_s there, with its
// derivatives as x moves: closed forms, nothing in the way. Every factor's logarithm is differentiated.
namespace isophote::test {

/// The phase function of Henyey and Greenstein, by the cosine of the deflection; g > 0 is
/// forward.
struct HenyeyGreenstein {
  double g;

  double operator()(double cosine) const {
    const double d = denominator(cosine);
    return (1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d));
  }
  /// First and second derivative of its logarithm by the cosine.
  double log_slope(double cosine) const { return 3 * g / denominator(cosine); }
  double log_curvature(double cosine) const {
    const double d = denominator(cosine);
    return 6 * g * g / (d * d);
  }

 private:
  double denominator(double cosine) const { return 1 + g * g - 2 * g * cosine; }
};

/// A positive function of position, by its value and the derivatives of its logarithm.
struct LogJet {
  double value = 1;
  Vec3d log_gradient;
  Sym3d log_hessian;

  LogJet operator*(const LogJet& o) const {
    return {value * o.value, log_gradient + o.log_gradient, log_hessian + o.log_hessian};
  }
  Vec3d gradient() const { return log_gradient * value; }
  Sym3d hessian() const { return (Sym3d::outer(log_gradient, 1) + log_hessian) * value; }
};

/// A place y as seen from x, which moves.
struct SeenPlace {
  Vec3d w;
  double r;

  SeenPlace(const Vec3d& x, const Vec3d& y) : w(normalize(y - x)), r(length(y - x)) {}

  /// The cosine between -w, which is how light travels, and a direction.
  double cosine(const Vec3d& along) const { return -dot(w, along); }
  Vec3d cosine_gradient(const Vec3d& along) const { return (along - w * dot(w, along)) / r; }
  Sym3d cosine_hessian(const Vec3d& along) const {
    return Sym3d::symmetric_outer(w, cosine_gradient(along), 1 / r) + Sym3d::across(w) * (-cosine(along) / (r * r));
  }

  LogJet phase(const HenyeyGreenstein& f, const Vec3d& wo) const {
    const double c = cosine(wo);
    return {f(c), cosine_gradient(wo) * f.log_slope(c),
            Sym3d::outer(cosine_gradient(wo), f.log_curvature(c)) + cosine_hessian(wo) * f.log_slope(c)};
  }
  /// 1 / r^n
  LogJet inverse_power(int n) const {
    const Sym3d curvature = Sym3d::outer(w, 2) + Sym3d::scaled_identity(-1);
    return {std::pow(r, -n), w * (n / r), curvature * (n / (r * r))};
  }
  /// The cosine to the n of the angle between how light travels and an axis.
  LogJet cosine_power(const Vec3d& axis, double n) const {
    const double c = cosine(axis);
    const Vec3d slope = cosine_gradient(axis) * (1 / c);
    return {std::pow(c, n), slope * n, (cosine_hessian(axis) * (1 / c) + Sym3d::outer(slope, -1)) * n};
  }
  LogJet transmittance(const AnalyticMedium& medium, const Vec3d& x) const {
    return {medium.transmittance(x, w, r), medium.log_gradient(x, w, r), medium.log_hessian(x, w, r)};
  }
};

/// A point light of some intensity.
inline LogJet scattered_point(const Vec3d& x, const Vec3d& light, double intensity, const AnalyticMedium& medium,
                              const HenyeyGreenstein& f, const Vec3d& wo) {
  const SeenPlace y(x, light);
  return LogJet{intensity, {}, {}} * y.phase(f, wo) * y.inverse_power(2) * y.transmittance(medium, x);
}

/// A spot light: its intensity falls with the n-th power of the cosine to its axis.
inline LogJet scattered_spot(const Vec3d& x, const Vec3d& light, const Vec3d& axis, double n, double intensity,
                             const AnalyticMedium& medium, const HenyeyGreenstein& f, const Vec3d& wo) {
  return scattered_point(x, light, intensity, medium, f, wo) * SeenPlace(x, light).cosine_power(axis, n);
}

/// A piece of a diffuse emitter, per area: cos / r^2 of its radiance.
inline LogJet scattered_area(const Vec3d& x, const Vec3d& light, const Vec3d& normal, double radiance,
                             const AnalyticMedium& medium, const HenyeyGreenstein& f, const Vec3d& wo) {
  return scattered_spot(x, light, normal, 1, radiance, medium, f, wo);
}

/// Light of one direction and irradiance, of which the medium begins at the plane normal . p = offset. Second
/// derivatives are left 0.
inline LogJet scattered_directional(const Vec3d& x, const Vec3d& direction, double irradiance, const Vec3d& normal,
                                    double offset, const AnalyticMedium& medium, const HenyeyGreenstein& f,
                                    const Vec3d& wo) {
  const double s = (dot(normal, x) - offset) / dot(normal, direction);
  const Vec3d entry = x - direction * s;
  Vec3d slopes;
  GaussRule<32>::get().integrate(0, s,
                                 [&](double u, double weight) { slopes += medium.slope(x - direction * u) * weight; });
  return {f(dot(direction, wo)) * irradiance * medium.transmittance(x, -direction, s),
          -slopes - normal * (medium.extinction(entry) / dot(normal, direction)),
          {}};
}

}  // namespace isophote::test
