#pragma once

#include "isophote/trace/path.h"
#include "support/statistics.h"

namespace isophote {

/// A scene with what light transport needs of it.
struct Stage {
  Scene scene;
  RayCaster rays{scene};
  Emitters emitters{scene};
  Media media{scene};
  World world{scene, rays, emitters, std::numeric_limits<int>::max(), scene.media.empty() ? nullptr : &media};
  RayCounts counts;

  explicit Stage(Scene s) : scene(std::move(s)) {}
  Stage(const Stage&) = delete;

  SurfacePoint hit(const Vec3& origin, const Vec3& direction) const {
    const Ray ray{origin, normalize(direction)};
    Hit h;
    EXPECT_TRUE(rays.intersect(ray, 0, h));
    return surface_point(scene, ray, h);
  }
  /// Radiance that arrives along a ray, by the path tracer: one sample.
  Scattered radiance(const Ray& ray, Sampler& sampler) {
    const FirstPoint first = first_point(world, ray, true, sampler, counts.camera);
    Scattered out;
    if (first.point) out = scatter(world, *first.point, -first.direction, first.depth, sampler, counts);
    if (first.medium_point) out = scatter(world, *first.medium_point, first.direction, first.depth, sampler, counts);
    out.direct = first.emission + first.throughput * out.direct;
    out.indirect *= first.throughput;
    return out;
  }
};

/// Independent samplers.
inline Sampler test_sampler(std::uint64_t seed, int sample) {
  return {Purpose::test, seed, static_cast<std::uint64_t>(sample), 0};
}

}  // namespace isophote
