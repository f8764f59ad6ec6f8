#include "isophote/cache/octree.h"

namespace isophote {
namespace {

/// No cell is smaller than the root's size over 2^21: below that, floats no longer tell cells apart.
constexpr float smallest_cell = 0x1p-21f;

bool touches(const Vec3& cell, float half, const Vec3& center, float radius) {
  const auto outside = [half](float d) { return std::max(0.0f, std::abs(d) - half); };
  const Vec3 gap{outside(center.x - cell.x), outside(center.y - cell.y), outside(center.z - cell.z)};
  return length_squared(gap) <= radius * radius;
}

}  // namespace

Octree::Octree(const Box& bounds)
    : center_(bounds.empty() ? Vec3{} : bounds.center()),
      half_(bounds.empty() ? 1.0f : std::max(max_component(bounds.size()) * 0.5f, 1e-30f)),
      nodes_(1) {}

void Octree::insert(std::uint32_t id, const Vec3& center, float radius) { insert(0, center_, half_, id, center, radius); }

void Octree::insert(std::uint32_t node, const Vec3& node_center, float half, std::uint32_t id, const Vec3& center,
                    float radius) {
  if (half <= 2 * radius || half <= half_ * smallest_cell) {
    nodes_[node].ids.push_back(id);
    return;
  }
  half *= 0.5f;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 child_at = child_center(node_center, half, octant);
    if (!touches(child_at, half, center, radius)) continue;
    if (nodes_[node].children[octant] == 0) {
      nodes_[node].children[octant] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    }
    insert(nodes_[node].children[octant], child_at, half, id, center, radius);
  }
}

}  // namespace isophote
