#pragma once

#include <string>

#include "isophote/core/parallel.h"

namespace isophote::bench {

/// Prints JSON: along a line of the occluded plane its irradiance, that extrapolated to first and second order from one
/// place, and over the reach the total errors of both and what the line form of the total error says.
void print_line();

/// Writes into `folder` pictures of the gradient's length and the Hessian's eigenvalues over the occluded plane, exact
/// and by each estimator at three numbers of rays; prints lines of JSON with the estimators' errors.
void draw_derivatives(const std::string& folder, const ParallelFor& parallel);

}  // namespace isophote::bench
