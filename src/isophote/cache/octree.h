#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isophote/core/vec.h"

namespace isophote {

/// Finds which of many spheres may contain a point. A sphere is referenced from every cell its box touches on the level
/// where cells are about as large as it [Ward, Rubinstein, Clear 1988], so that a query walks one path from the root to
/// a leaf. The bounds are where most spheres lie; beyond them the outermost cells go on for ever. Insertion is serial;
/// any number of threads may query in between.
class Octree {
 public:
  explicit Octree(const Box& bounds);

  void insert(std::uint32_t id, const Vec3& center, float radius);

  /// Does test(id) hold for any sphere that contains `p`? Asks it of all those, and of some that rounding might have
  /// grow to contain `p`, in an order fixed by the insertions, until it holds.
  template <class Test>
  bool any(const Vec3& p, Test&& test) const {
    return descend(p, [&](const Sphere& s) { return length_squared(p - s.center) <= s.reach && test(s.id); });
  }

  /// Calls visit(id) for all spheres that contain `p`, and for some others near it.
  template <class Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    descend(p, [&](const Sphere& s) { return visit(s.id), false; });
  }

 private:
  /// Kept where queries pass, so that what the spheres stand for is not touched where they are missed, as most are.
  struct Sphere {
    Vec3 center;
    float reach;  // squared radius, a little more
    std::uint32_t id;
  };
  struct Node {
    std::array<std::uint32_t, 8> children{};  // 0: none, for the root is nobody's child
    std::vector<Sphere> spheres;
  };

  template <class Test>
  bool descend(const Vec3& p, Test&& test) const {
    Vec3 center = center_;
    float half = half_;
    for (std::uint32_t node = 0;;) {
      for (const Sphere& sphere : nodes_[node].spheres)
        if (test(sphere)) return true;
      const int octant = (p.x > center.x) | (p.y > center.y) << 1 | (p.z > center.z) << 2;
      node = nodes_[node].children[octant];
      if (node == 0) return false;
      half *= 0.5f;
      center = child_center(center, half, octant);
    }
  }
  static Vec3 child_center(const Vec3& c, float half, int octant) {
    return {octant & 1 ? c.x + half : c.x - half, octant & 2 ? c.y + half : c.y - half,
            octant & 4 ? c.z + half : c.z - half};
  }
  void insert(std::uint32_t node, const Vec3& node_center, float half, const Sphere& sphere, float radius);

  Vec3 center_;
  float half_;
  std::vector<Node> nodes_;
};

}  // namespace isophote
