#pragma once

#include <cmath>
#include <numbers>

#include "isophote/core/sym3.h"
#include "isophote/derivatives/volume_sum.h"

// Light of a place at distance r along w is a product of factors that change smoothly as the record moves and the place
// stays. Here they are, by the first and second derivatives of their logarithms.
namespace isophote {

/// What light that arrives is weighed by: the phase function of Henyey and Greenstein for light that goes on along the
/// unit vector `wo`. With g = 0 it is the mean over directions.
struct Lobe {
  double g = 0;
  Vec3d wo{};
};

/// The part of a vector across the unit vector w.
inline Vec3d across(const Vec3d& w, const Vec3d& v) { return v - w * dot(v, w); }

struct LobeFactor {
  double value = 1 / (4 * std::numbers::pi);
  Vec3d gradient;
  Sym3d hessian;

  LobeFactor(const Lobe& lobe, const Vec3d& w, double r) {
    const double g = lobe.g;
    if (g == 0) return;
    const double cosine = -dot(lobe.wo, w), d = 1 + g * g - 2 * g * cosine;
    const Vec3d slope = across(w, lobe.wo) / r;  // of the cosine
    value = (1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d));
    gradient = slope * (3 * g / d);
    hessian = Sym3d::outer(slope, 6 * g * g / (d * d)) +
              (Sym3d::symmetric_outer(w, slope, 1 / r) + Sym3d::across(w) * (-cosine / (r * r))) * (3 * g / d);
  }
};

/// The second derivatives that go with a layer's logarithmic gradient, as far as that says. Along w it is the
/// extinction at the record, and media are taken to be as dense all the way; across w it is `turned`, on surfaces by
/// how transmittance differs between ways, on media mostly by where sources shine.
inline Sym3d log_hessian(const Vec3d& w, double r, const Vec3d& log_gradient, bool surface) {
  const double extinction = dot(log_gradient, w);
  const Vec3d turned = log_gradient - w * extinction;
  return Sym3d::across(w) * (-extinction / r) + Sym3d::symmetric_outer(w, turned, (surface ? -1 : 1) / r);
}

/// And how the part across w, at unit distance, differs between three places seen along a, b and c, for a source that
/// depends on direction alone.
inline Sym3d turning_hessian(const Vec3d& w, double r, const Vec3d (&directions)[3], const Vec3d (&turns)[3]) {
  const Vec3d ab = directions[1] - directions[0], ac = directions[2] - directions[0], normal = cross(ab, ac);
  const double scale = -0.5 / (length_squared(normal) * r * r);
  // Of two vectors in the plane of ab and ac, each is normal to one and has a product of 1 with the other.
  const Vec3d along_b = cross(ac, normal), along_c = cross(normal, ab);
  return Sym3d::symmetric_outer(across(w, turns[1] - turns[0]), across(w, along_b), scale) +
         Sym3d::symmetric_outer(across(w, turns[2] - turns[0]), across(w, along_c), scale);
}

}  // namespace isophote
