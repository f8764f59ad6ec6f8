#include "isophote/load/gltf_nodes.h"

#include <cmath>

#include "isophote/load/messages.h"

namespace isophote {
namespace {

constexpr int no_parent = -1;

std::vector<int> find_parents(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), no_parent);
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    for (const int child : model.nodes[i].children) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent != no_parent) throw UserError(node_place(model, child) + ": has two parents");
      parent = static_cast<int>(i);
    }
  return parents;
}

/// Follows each node's parents upwards; `clear` marks those from which the way is known to end.
void refuse_cycles(const tinygltf::Model& model, const std::vector<int>& parents) {
  std::vector<bool> clear(parents.size(), false);
  for (std::size_t start = 0; start < parents.size(); ++start) {
    std::vector<int> way;
    for (int node = static_cast<int>(start); node != no_parent && !clear[static_cast<std::size_t>(node)];
         node = parents[static_cast<std::size_t>(node)]) {
      if (way.size() > parents.size()) throw UserError(node_place(model, node) + ": is its own ancestor");
      way.push_back(node);
    }
    for (const int node : way) clear[static_cast<std::size_t>(node)] = true;
  }
}

std::vector<int> find_roots(const tinygltf::Model& model, const std::vector<int>& parents) {
  std::vector<int> roots;
  if (model.scenes.empty()) {
    for (std::size_t i = 0; i < parents.size(); ++i)
      if (parents[i] == no_parent) roots.push_back(static_cast<int>(i));
    return roots;
  }
  const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  std::vector<bool> seen(parents.size(), false);
  for (const int node : model.scenes[scene].nodes) {
    const auto i = static_cast<std::size_t>(node);
    if (parents[i] != no_parent) throw UserError(node_place(model, node) + ": is a root of the scene and has a parent");
    if (seen[i]) throw UserError(node_place(model, node) + ": is twice a root of the scene");
    seen[i] = true;
    roots.push_back(node);
  }
  return roots;
}

Affine from_matrix(const std::vector<double>& m) {
  constexpr double tolerance = 1e-6;  // writers round
  const bool affine = std::abs(m[3]) < tolerance && std::abs(m[7]) < tolerance && std::abs(m[11]) < tolerance &&
                      std::abs(m[15] - 1) < tolerance;
  if (!affine) throw UserError("matrix: is not affine: its last row is not 0 0 0 1");
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

/// The columns of the rotation by a quaternion (x, y, z, w) of any length but 0.
Affine from_quaternion(const std::vector<double>& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3], n = x * x + y * y + z * z + w * w;
  if (!(n > 0) || !std::isfinite(n)) throw UserError("rotation: is not a quaternion that can be normalised");
  const double s = 2 / n;
  Affine a;
  a.x = {1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)};
  a.y = {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)};
  a.z = {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)};
  return a;
}

Affine local_transform(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return from_matrix(node.matrix);
  Affine a;
  if (!node.rotation.empty()) a = from_quaternion(node.rotation);
  if (!node.scale.empty()) a.x *= node.scale[0], a.y *= node.scale[1], a.z *= node.scale[2];
  if (!node.translation.empty()) a.origin = {node.translation[0], node.translation[1], node.translation[2]};
  return a;
}

}  // namespace

std::string node_place(const tinygltf::Model& model, int node) {
  const auto i = static_cast<std::size_t>(node);
  return place_name("nodes", i, model.nodes[i].name);
}

std::vector<PlacedNode> place_nodes(const tinygltf::Model& model) {
  constexpr int deepest = 1000;
  struct Pending {
    int node, depth;
    Affine parent_to_world;
  };
  const std::vector<int> parents = find_parents(model);
  refuse_cycles(model, parents);
  std::vector<Pending> stack;
  const std::vector<int> roots = find_roots(model, parents);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, 0, {}});

  std::vector<PlacedNode> placed;
  while (!stack.empty()) {
    const Pending next = stack.back();
    stack.pop_back();
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(next.node)];
    with_place(node_place(model, next.node), [&] {
      if (next.depth > deepest) throw UserError("is nested deeper than " + std::to_string(deepest) + " levels");
      placed.push_back({next.node, next.parent_to_world * local_transform(node)});
    });
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      stack.push_back({*child, next.depth + 1, placed.back().to_world});
  }
  return placed;
}

}  // namespace isophote
