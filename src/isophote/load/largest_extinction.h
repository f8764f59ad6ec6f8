#pragma once

namespace isophote {

/// The most that a medium may scatter and absorb anywhere, 1/m: beyond, a free flight is lost in the rounding of
/// places.
inline constexpr float largest_extinction = 1e9f;

}  // namespace isophote
