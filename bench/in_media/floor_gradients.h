#pragma once

#include <string>

#include "isophote/core/parallel.h"

namespace isophote::bench {

/// Gradients of irradiance over the floor of a room with a shaft of sunlight in a homogeneous medium, by estimators
/// that know of media or do not, against differences of fine quadratures: prints lines of JSON, and writes into
/// `folder` pictures in false colours of the irradiance without and with the medium, of the gradients' lengths and of
/// what they are off by.
void draw_floor_gradients(const std::string& folder, const ParallelFor& parallel);

}  // namespace isophote::bench
