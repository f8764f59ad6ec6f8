#pragma once

#include <string>

#include "isophote/cache/catalogue.h"

namespace isophote::bench {

/// A method to compare: the name of a preset, then any of +estimator=NAME +order=N +aspect=X +neighbours=SLOPE.
/// Secondary caching is off: all are given the same gathers.
Method variant(const std::string& text);

}  // namespace isophote::bench
