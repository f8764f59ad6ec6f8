#include "isophote/cache/octree.h"

namespace isophote {
namespace {

/// No cell is smaller than the root's size over 2^21: below that, floats no longer tell cells apart.
constexpr float smallest_cell = 0x1p-21f;

/// Could a query for a point of the sphere take this octant? Asked with the query's own comparisons, and rounding is
/// monotonic, so that no point is lost between cells or outside the bounds.
bool reaches(const Vec3& node_center, int octant, const Vec3& center, float radius) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool upper = octant >> axis & 1;
    if (upper ? !(center[axis] + radius > node_center[axis]) : !(center[axis] - radius <= node_center[axis]))
      return false;
  }
  return true;
}

}  // namespace

Octree::Octree(const Box& bounds)
    : center_(bounds.empty() ? Vec3{} : bounds.center()),
      half_(bounds.empty() ? 1.0f : std::max(max_component(bounds.size()) * 0.5f, 1e-30f)),
      nodes_(1) {}

void Octree::insert(std::uint32_t id, const Vec3& center, float radius) {
  constexpr float rounding = 1 + 0x1p-18f;
  insert(0, center_, half_, {center, radius * radius * rounding, id}, radius);
}

void Octree::insert(std::uint32_t node, const Vec3& node_center, float half, const Sphere& sphere, float radius) {
  if (half <= 2 * radius || half <= half_ * smallest_cell) {
    nodes_[node].spheres.push_back(sphere);
    return;
  }
  half *= 0.5f;
  for (int octant = 0; octant < 8; ++octant) {
    if (!reaches(node_center, octant, sphere.center, radius)) continue;
    if (nodes_[node].children[octant] == 0) {
      nodes_[node].children[octant] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    }
    insert(nodes_[node].children[octant], child_center(node_center, half, octant), half, sphere, radius);
  }
}

}  // namespace isophote
