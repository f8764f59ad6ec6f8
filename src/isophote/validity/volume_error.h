#pragma once

#include <array>

#include "isophote/validity/radius_bounds.h"
#include "isophote/validity/volume_record.h"

namespace isophote {

/// Total error of first-order extrapolation in media [Marco 2018], after [Schwarzhaupt 2012]: the footprint over which
/// the integral of |second-order term|, at most, reaches the same eps everywhere. With the Hessian's eigenvalues l_i,
/// of luminance, that integral is 2 pi / 15 R^5 sum |l_i| over a ball, and over an ellipsoid along its axes
/// 2 pi / 15 r_1 r_2 r_3 sum |l_i| r_i^2, which holds the largest volume if |l_i| r_i^2 is the same for all three. No
/// axis is longer than `aspect` times another; aspect 1 is the ball. docs/theory.md derives it.
///
/// `wanted` is the mean to aim at of what this bounds, over the mean luminance: eps is such that the mean over a
/// footprint, averaged over the visible media, is that, `rate` being the mean of `volume_error_rate` there (View's
/// pilot: its error_rate, and in `irradiance` the mean of `mean_over_directions`). Without a pilot eps is that of a
/// ball which has this mean itself, relative to its own value. No radius is above a quarter of the scene's diagonal,
/// which a place where the Hessian happens to vanish would else exceed. `bounds.gradient` has the footprint end along
/// the gradient of luminance where light has changed by as much as itself, which keeps an error that is allowed for the
/// picture from being many times what there is at a dark place.
Footprint volume_error(const VolumeJet& jet, const View& view, float wanted, const RadiusBounds& bounds, float aspect);

/// (sum |l_i| / L)^(3/5) / 10 at one place, 1 / length^(6/5), L being the picture's mean luminance: with the radius
/// R^5 = (wanted / rate)^(5/2) L / sum |l_i|, the mean error over a ball is `wanted` times this over the mean of all.
float volume_error_rate(const VolumeJet& jet, float mean);

/// The semi-axes of the largest ellipsoid over which the integral is at most `eps`: of absolute eigenvalues, the
/// largest of which is above 0.
std::array<double, 3> volume_error_axes(std::array<double, 3> curvatures, double eps, double aspect);

}  // namespace isophote
