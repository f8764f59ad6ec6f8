#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isophote/trace/ray_caster.h"

namespace isophote {

/// A part of a ray that lies within one medium's bounds.
struct MediumSpan {
  float near = 0, far = 0;
  std::uint32_t medium = 0;
  /// Normals of the bounds where the ray comes in and goes out, of any length and side; 0 where the ray itself starts
  /// or ends within.
  Vec3 near_normal{}, far_normal{};
};

/// The bounds of a scene's media.
class MediumBounds {
 public:
  explicit MediumBounds(std::span<const Medium> media);

  /// Calls visit(span) for all parts of the ray within media, medium by medium, near ones first.
  template <class Visit>
  void visit_spans(const Ray& ray, Visit&& visit) const {
    for (const Bounds& bounds : all_) {
      Crossings along(bounds, ray);
      for (MediumSpan span; along.next(span);) visit(span);
    }
  }

 private:
  /// A box, or a closed mesh within one.
  struct Bounds {
    std::uint32_t medium;
    Box box;
    std::unique_ptr<Scene> mesh;
    std::unique_ptr<RayCaster> rays;
  };

  /// The parts of a ray within one bounds, one after the other.
  class Crossings {
   public:
    Crossings(const Bounds& bounds, const Ray& ray);
    bool next(MediumSpan& span);

   private:
    bool next_of_mesh(MediumSpan& span);

    const Bounds& bounds_;
    Ray ray_;
    float end_;
    Vec3 box_near_{}, box_far_{};  // normals
    bool first_ = true;
  };

  std::vector<Bounds> all_;
};

}  // namespace isophote
