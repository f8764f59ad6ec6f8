#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "isophote/load/gltf_accessors.h"

namespace isophote {

using Triangle = std::array<std::uint32_t, 3>;

/// How many triangles a primitive's mode (TINYGLTF_MODE_*) makes of `vertices`; nothing for points and lines.
std::optional<std::size_t> triangle_count(int mode, std::size_t vertices);

/// The triangles of a list, strip or fan, all wound alike, without those that name a vertex twice. Throws UserError for
/// indices beyond `vertex_count`.
std::vector<Triangle> assemble_triangles(int mode, const std::optional<AccessorReader>& indices,
                                         std::size_t vertex_count);

/// Numbers the vertices that the triangles use from 0 in the order of their ids, and returns the ids.
std::vector<std::uint32_t> compact_vertices(std::vector<Triangle>& triangles, std::size_t vertex_count);

}  // namespace isophote
