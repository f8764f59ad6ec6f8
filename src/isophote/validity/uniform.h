#pragma once

#include "isophote/validity/footprint.h"

namespace isophote {

/// The control in every comparison: one radius everywhere, `a` times a tenth of the scene's diagonal.
Footprint uniform(const View& view, float a);
/// The same in media.
Footprint uniform_in_media(const View& view, float a);

}  // namespace isophote
