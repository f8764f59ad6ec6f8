#pragma once

#include <algorithm>
#include <cmath>

#include "isophote/core/frame.h"
#include "isophote/core/ray.h"
#include "isophote/core/vec.h"

namespace isophote {

/// 1 + g^2 - 2 g cosine, in a form that loses no digits where |g| and the cosine are near 1.
inline float henyey_greenstein_root(float g, float cosine) {
  const float a = std::abs(g), turned = std::max(0.0f, g < 0 ? 1 + cosine : 1 - cosine);
  return (1 - a) * (1 - a) + 2 * a * turned;
}

/// The phase function of [Henyey, Greenstein 1941], 1/sr: the density in solid angle of the direction after scattering.
/// `cosine` is that of the angle between the directions of propagation before and after (1: straight on), `g` in
/// (-1, 1) its mean.
inline float henyey_greenstein(float g, float cosine) {
  const float a = std::abs(g), d = henyey_greenstein_root(g, cosine);
  return (1 - a) * (1 + a) / (4 * pi * d * std::sqrt(d));
}

/// By how much the logarithm of `henyey_greenstein(g, dot(direction, other))` changes as `direction` turns on the
/// sphere: a vector across it, per radian.
inline Vec3 henyey_greenstein_turn(float g, const Vec3& direction, const Vec3& other) {
  const float cosine = dot(direction, other);
  return (other - direction * cosine) * (3 * g / henyey_greenstein_root(g, cosine));
}

/// A direction of propagation after scattering, with density `henyey_greenstein`; `forward` is that before, unit. The
/// distribution of the cosine inverted, written as what is left to 1 and to -1: products of positive numbers, without
/// the division by g that the usual form has. u.x = 0 goes straight on.
inline Vec3 sample_henyey_greenstein(float g, const Vec3& forward, Vec2 u) {
  const float v = 1 - u.x, d = (1 - g) * u.x + (1 + g) * v;  // 1 + g - 2 g u.x
  const float below = (1 - g) / d, above = (1 + g) / d;
  const float one_minus = 2 * u.x * below * below * (1 + g * v), one_plus = 2 * v * above * above * (1 - g * u.x);
  const float cosine = one_plus > 1 ? 1 - one_minus : one_plus - 1;
  const float sine = std::sqrt(std::max(0.0f, one_minus * one_plus)), phi = 2 * pi * u.y;
  return Frame(forward).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
}

}  // namespace isophote
