#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isophote/load/gltf_nodes.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// The meshes of all nodes, one for each primitive of each instance, in world space. Vertices that no triangle uses are
/// left out, as are triangles without an area (counted in one warning, as are primitives of which nothing is left) and
/// attributes that the material does not need. Primitives without material get the id `default_material`. All memory is
/// taken from the budget before anything is allocated. Throws UserError `meshes[I] "NAME": primitives[J]: reason`.
std::vector<Mesh> read_meshes(const tinygltf::Model& model, std::span<const PlacedNode> nodes,
                              std::span<const Material> materials, int default_material, MemoryBudget& budget,
                              const Warn& warn);

/// Does one of these nodes have a primitive without material?
bool uses_default_material(const tinygltf::Model& model, std::span<const PlacedNode> nodes);

}  // namespace isophote
