#pragma once

#include "isophote/core/vec.h"

namespace isophote {

/// The solid angle that a triangle fills, seen from the origin [van Oosterom, Strackee 1983]; without sign.
double solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// The same but for a factor between 0.94 and 1.57, at less cost.
double about_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// A unit vector into the triangle of the vertices, uniform over its solid angle, which is given [Arvo 1995]: between
/// 1e-7 and 2 pi - 2e-6, beyond which rounding rules.
Vec3d uniform_spherical_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, double solid_angle, Vec2 u);

}  // namespace isophote
