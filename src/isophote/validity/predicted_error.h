#pragma once

#include "isophote/validity/record.h"

namespace isophote {

/// What a method's predictions rest on.
struct ErrorModel {
  bool by_hessian = false;      ///< the records' Hessians are estimated; else the metric's own measure has to do
  float threshold = 0;          ///< of the metric: its measure at the rim of a footprint that nothing has bounded
  float scale = 1;              ///< the radius of such a footprint over the unscaled one
  float factor = 1, power = 1;  ///< a threshold of factor * error^power aims at that mean relative error
};

/// The relative error of irradiance that the use of `record` at record.position + q, on the normal n, predicts: of 1 at
/// most, beyond which nothing is foretold.
///
/// With a Hessian H, it is what the extrapolation leaves out of the second-order expansion: |q . H q| / 2 over the
/// value's luminance [Jarosz 2012], and whatever of the gradients goes unused, by the order of the extrapolation or by
/// its limit. To records extrapolated to the second order the same is ascribed, which they stay below where the
/// expansion converges: of the third-order term that they do leave out, nothing is known.
///
/// Without one, it is the error for which the metric's measure at that place would be the threshold. The measure itself
/// will not do: that of the split sphere bounds the relative change of the irradiance [Ward, Rubinstein, Clear 1988],
/// most of which gradients and neighbours make good.
float predicted_error(const Record& record, const Vec3& q, const Vec3& n, const ErrorModel& model);

/// The mean of that along the rim of the footprint, for equal normals: the most that the record is used for.
float predicted_error_at_rim(const Record& record, const ErrorModel& model);

}  // namespace isophote
