#include "isophote/trace/medium_pieces.h"

#include <algorithm>
#include <cmath>

#include "isophote/scene/density_grid.h"
#include "isophote/trace/density_walk.h"

namespace isophote {
namespace {

/// The mean density of a piece: in a grid, that of its middle.
float roughly(const Medium& medium, const Ray& ray, float near, float size) {
  if (const auto* grid = std::get_if<GridDensity>(&medium.density))
    return (*grid)->density(ray.origin + ray.direction * (near + size / 2));
  return static_cast<float>(columns(medium, ray, near, near + size).density) / size;
}

/// The least that may be missed around such a middle.
float least_density(const Medium& medium) {
  constexpr float least = 0.02f;
  const auto* grid = std::get_if<GridDensity>(&medium.density);
  return grid ? least * (*grid)->majorant() : 0;
}

}  // namespace

void cut(const Medium& medium, const Ray& ray, const MediumSpan& span, int count, std::vector<MediumPiece>& pieces) {
  const float length = span.far - span.near, size = length / static_cast<float>(count);
  if (!(size > 0)) return;
  const float glow = is_black(medium.emission) ? 0 : std::max(mean(medium.extinction()), 1 / length);
  const float least = least_density(medium);
  for (int i = 0; i < count; ++i) {
    const float near = span.near + size * static_cast<float>(i), density = roughly(medium, ray, near, size);
    pieces.push_back({span.medium, near, size, (medium.scattering + Rgb(glow)) * std::max(density, least),
                      medium.extinction() * density, 0});
  }
}

float weigh(std::vector<MediumPiece>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.near < b.near; });
  constexpr float blind = 0.1f;
  float seen = 0, all = 0;
  Rgb passed(1.0f);
  for (MediumPiece& p : pieces) {
    const Rgb within = p.extinction * p.size, left = exp(within * -1.0f);
    Rgb mean_passed;
    for (int c = 0; c < 3; ++c)
      mean_passed[c] = passed[c] * (within[c] > 1e-3f ? (1 - left[c]) / within[c] : 1 - within[c] / 2);
    p.weight = mean(p.scattering * mean_passed) * p.size;
    passed *= left;
    seen += p.weight, all += mean(p.scattering) * p.size;
  }
  if (!(all > 0)) return 0;
  const float scale = seen > 0 ? (1 - blind) / seen : 0;
  float total = 0;
  for (MediumPiece& p : pieces) {
    p.weight = scale * p.weight + blind / all * mean(p.scattering) * p.size;
    total += p.weight;
  }
  return total;
}

}  // namespace isophote
