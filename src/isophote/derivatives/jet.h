#pragma once

#include <cstdint>
#include <limits>

#include "isophote/core/gradient.h"
#include "isophote/core/rgb.h"
#include "isophote/core/sym3.h"
#include "isophote/core/vec.h"
#include "isophote/derivatives/obstacles.h"

namespace isophote {

/// How far the surfaces are that a record sees.
struct DistanceStats {
  float harmonic_mean = 0;  ///< along cosine-distributed rays; infinity under an open sky
  Obstacles obstacles;
};

/// A value with its derivatives. Units: irradiance in W/m2 (cosine-weighted solid angle), gradients per metre and per
/// radian. The value at position + d with the normal turned from n_i to n is about value + translational.dot(d) +
/// rotational.dot(n_i x n).
template <class V>
struct Jet {
  V value{};
  Gradient<V> translational;  ///< the position moves, the normal stays
  Gradient<V> rotational;     ///< the normal turns, the position stays
  Sym3 hessian;               ///< of luminance, per square metre, in the tangent plane; zero where none is estimated
  float standard_error = 0;   ///< of the value's luminance, judged by the samples that made it
  float gradient_error = std::numeric_limits<float>::infinity();  ///< of a component of the translational gradient,
                                                                  ///< likewise; infinite where none is known
  std::uint32_t rays = 0;                                         ///< how many those were
  DistanceStats distances;
};

}  // namespace isophote
