#pragma once

#include <cstdint>
#include <memory>

#include "isophote/core/ray.h"
#include "isophote/scene/scene.h"
#include "isophote/scene/surface.h"

namespace isophote {

/// Answers which triangle a ray meets. Alpha-masked triangles count only where they are opaque; alpha-blended ones by
/// chance, decided by `seed` and the place, so that coverage is right on average and repeatable. Safe to use from any
/// number of threads.
class RayCaster {
 public:
  /// Builds the acceleration structure over `scene`, which must outlive this. Throws UserError where memory runs out.
  explicit RayCaster(const Scene& scene);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// The nearest hit with ray.near < distance < ray.far.
  bool intersect(const Ray& ray, std::uint32_t seed, Hit& hit) const;
  bool occluded(const Ray& ray, std::uint32_t seed) const;

  /// The diagonal of the scene's bounds; of those of its media where it has no meshes.
  float scene_scale() const;
  /// Do any materials let light straight through, thin and transmissive?
  bool has_sheets() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Denormal floats are flushed to zero while this lives, as the ray tracer wants it; every worker that traces holds
/// one, so that all compute alike.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace isophote
