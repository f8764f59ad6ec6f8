#pragma once

namespace isophote {

/// The most that a light or an environment may give, in its own unit: sums and weights of samples need room above it in
/// a float.
inline constexpr float largest_radiance = 1e30f;

}  // namespace isophote
