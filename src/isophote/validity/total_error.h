#pragma once

#include "isophote/derivatives/jet.h"
#include "isophote/validity/radius_bounds.h"

namespace isophote {

/// Total error of first-order extrapolation [Jarosz 2012], [Schwarzhaupt 2012]: the radius at which the integral over
/// the footprint of |second-order term| / E reaches the same eps everywhere. With the tangential Hessian's eigenvalues
/// l1, l2 over E, a disk has R^4 = 8 eps / (pi (|l1| + |l2|)), an ellipse the semi-axes R_k^4 = 4 eps / (pi |l_k|), of
/// which the longer is at most `aspect` times the shorter; aspect 1 is the disk. Along the normal a footprint ends at
/// its shorter axis.
///
/// `wanted` is the mean to aim at of what this bounds, relative: eps / (pi R^2) averages to it over the visible points
/// if eps = (wanted / rate)^2, rate being the mean of `error_rate` over them (Pilot). No radius is above a quarter of
/// the scene's diagonal, which a place where the Hessian happens to vanish would else exceed.
Footprint total_error(const Jet<Rgb>& jet, const View& view, float wanted, const RadiusBounds& bounds, float aspect);

/// sqrt((|l1| + |l2|) / (8 pi)) at one place, 1/length. `irradiance` is the picture's mean luminance, of which a
/// hundredth keeps black places finite.
float error_rate(const Jet<Rgb>& jet, const Vec3& normal, float irradiance);

/// The radius at which that integral along a line, where the second derivative is `curvature`, reaches eps: |curvature|
/// x^2 / 2 over [-R, R] is |curvature| R^3 / 3.
double total_error_on_line(double curvature, double eps);

}  // namespace isophote
