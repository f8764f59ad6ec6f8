#include "isophote/trace/medium_pieces.h"

#include <algorithm>
#include <cmath>

#include "isophote/scene/density_grid.h"
#include "isophote/trace/density_walk.h"

namespace isophote {
namespace {

/// Density of a piece: in grids never so small that other places of its surroundings would be missed.
float roughly(const Medium& medium, const Ray& ray, float near, float size) {
  constexpr float least = 0.02f;
  if (const auto* grid = std::get_if<GridDensity>(&medium.density))
    return std::max((*grid)->density(ray.origin + ray.direction * (near + size / 2)), least * (*grid)->majorant());
  return static_cast<float>(columns(medium, ray, near, near + size).density) / size;
}

}  // namespace

void cut(const Medium& medium, const Ray& ray, const MediumSpan& span, int count, std::vector<MediumPiece>& pieces) {
  const float length = span.far - span.near, size = length / static_cast<float>(count);
  if (!(size > 0)) return;
  const float glow = is_black(medium.emission) ? 0 : std::max(mean(medium.extinction()), 1 / length);
  for (int i = 0; i < count; ++i) {
    const float near = span.near + size * static_cast<float>(i), density = roughly(medium, ray, near, size);
    pieces.push_back(
        {span.medium, near, size, (mean(medium.scattering) + glow) * density, mean(medium.extinction()) * density, 0});
  }
}

float weigh(std::vector<MediumPiece>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.near < b.near; });
  float depth = 0, total = 0;
  for (MediumPiece& p : pieces) {
    const float within = p.extinction * p.size;
    p.weight = p.scattering * p.size * std::exp(-depth) * (within > 1e-4f ? -std::expm1(-within) / within : 1.0f);
    depth += within, total += p.weight;
  }
  return total;
}

}  // namespace isophote
