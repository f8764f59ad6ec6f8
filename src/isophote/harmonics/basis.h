#pragma once

#include <cstdint>
#include <span>

#include "isophote/core/vec.h"

namespace isophote {

/// Real orthonormal functions of a direction, in bands l = 0, 1, ... of 2 l + 1 each, without the sign of Condon and
/// Shortley: sqrt(2) cos(m phi) for m > 0, 1, sqrt(2) sin(|m| phi) for m < 0, times a function of theta. `spherical`
/// harmonics are orthonormal over the sphere, `hemispherical` ones [Gautron 2004] over the upper half of it, z >= 0.
enum class Basis : std::uint8_t { spherical, hemispherical };

/// An order is a number of bands.
inline constexpr int most_order = 16;
constexpr int harmonics_count(int order) { return order * order; }
constexpr int harmonic_index(int l, int m) { return l * (l + 1) + m; }

/// Values at the unit vector `w` of the first order^2 functions, by `harmonic_index`.
void evaluate_harmonics(Basis basis, int order, const Vec3d& w, std::span<double> values);
/// And their gradients on the sphere, which are tangent to it at `w`. Those of hemispherical ones grow without bounds
/// towards the horizon, as its sine's root does.
void evaluate_harmonics(Basis basis, int order, const Vec3d& w, std::span<double> values, std::span<Vec3d> slopes);

/// The parts of theta: of l and 0 <= m <= l at `polar_index`.
constexpr int polar_count(int order) { return order * (order + 1) / 2; }
constexpr int polar_index(int l, int m) { return l * (l + 1) / 2 + m; }

/// The normalised derivatives K_lm d^m P_l(z) / dz^m of Legendre's polynomials: the part of theta of a spherical
/// harmonic is this times sin^m(theta), at z = cos(theta).
void evaluate_legendre(int order, double z, std::span<double> values);

}  // namespace isophote
