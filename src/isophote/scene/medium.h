#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "isophote/core/rgb.h"
#include "isophote/core/vec.h"

namespace isophote {

class DensityGrid;

/// Density 1 everywhere.
struct UniformDensity {};
/// exp(-(y - base) / height): fog that thins upwards.
struct HeightDensity {
  float base = 0, height = 1;  ///< m; height above 0
};
/// Density of a grid, 0 outside it.
using GridDensity = std::shared_ptr<const DensityGrid>;

/// A closed surface: every edge belongs to two triangles, which turn it opposite ways; triangles face outwards.
struct ClosedMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What scatters, absorbs and emits between surfaces. Coefficients are those at density 1. It fills its bounds, glass
/// that lies within them included; where media overlap, their coefficients add up.
struct Medium {
  std::string name;
  Rgb scattering;  ///< sigma_s, 1/m
  Rgb absorption;  ///< sigma_a, 1/m
  Rgb emission;    ///< W/m3/sr
  float g = 0;     ///< mean cosine of the phase function [Henyey, Greenstein 1941], in (-1, 1): above 0 forwards
  std::variant<UniformDensity, HeightDensity, GridDensity> density;
  std::variant<Box, ClosedMesh> bounds;

  Rgb extinction() const { return scattering + absorption; }
};

}  // namespace isophote
