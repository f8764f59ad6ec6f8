#pragma once

#include "isophote/core/rgb.h"
#include "isophote/derivatives/incident_radiance.h"
#include "isophote/derivatives/jet.h"
#include "isophote/validity/footprint.h"

namespace isophote {

/// Where a record is and may be used, whatever it holds. What a lookup reads first comes first.
struct Site {
  Vec3 position;
  Vec3 normal;  ///< unit
  Footprint footprint;
  float gradient_scale = 1;  ///< what the limit on extrapolation leaves of the translational gradient
};

/// A place at which the irradiance is known, with its derivatives and the region where they may be used.
struct Record : Site {
  float curvature_scale = 0;  ///< of the Hessian: the part left of `whole_curvature`
  Jet<Rgb> jet;               ///< irradiance

  /// Half over the luminance of a value, which gives the second-order term its colour; 0 for the darkest values, whose
  /// reciprocal is beyond floats.
  static float whole_curvature(const Rgb& value) {
    const float twice = 2 * luminance(value);
    return twice > 1e-30f ? 1 / twice : 0;
  }

  /// The value extrapolated to position + d and, to first order, from `normal` to the unit vector n. The Hessian, known
  /// of luminance, is taken to have the value's colour. Never negative.
  Rgb extrapolate(const Vec3& d, const Vec3& n) const {
    if (footprint.order == 0) return jet.value;
    Rgb value = jet.value + jet.translational.dot(d) * gradient_scale + jet.rotational.dot(cross(normal, n));
    if (footprint.order > 1) value += jet.value * (curvature_scale * quadratic_form(jet.hessian, d));
    return max(value, Rgb{});
  }
};

/// A place at which incident radiance is known as a function of direction, in the frame that its normal has.
struct RadianceRecord : Site {
  RadianceJet jet;
};

}  // namespace isophote
