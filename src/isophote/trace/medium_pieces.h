#pragma once

#include <vector>

#include "isophote/scene/medium.h"
#include "isophote/trace/medium_spans.h"

namespace isophote {

/// A piece of a ray in one medium, for choosing where to look.
struct MediumPiece {
  std::uint32_t medium;
  float near, size;
  Rgb scattering, extinction;  ///< 1/m, about; the former with what is emitted
  float weight;                ///< how much is seen of it
};

/// Adds so many pieces of a span.
void cut(const Medium& medium, const Ray& ray, const MediumSpan& span, int count, std::vector<MediumPiece>& pieces);

/// Sorts pieces along the ray and gives them weights: scattering times transmittance from the first on, and a tenth of
/// all by scattering alone, for what is known of transmittance may be wrong. Returns their sum.
float weigh(std::vector<MediumPiece>& pieces);

}  // namespace isophote
