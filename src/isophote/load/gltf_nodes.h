#pragma once

#include <vector>

#include "isophote/core/affine.h"
#include "isophote/load/gltf_file.h"

namespace isophote {

/// A node of the scene and where it is.
struct PlacedNode {
  int node = 0;
  Affine to_world;
};

/// The nodes of the default scene (else the first; else, without scenes, all nodes), parents before children. Throws
/// UserError for cycles, a node with two parents, nesting beyond 1000 levels and matrices that are not affine.
std::vector<PlacedNode> place_nodes(const tinygltf::Model& model);

/// What messages call a node.
std::string node_place(const tinygltf::Model& model, int node);

}  // namespace isophote
