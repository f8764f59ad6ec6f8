// A host of isophote::render: a square lamp one metre above a floor, both made in code; the light that the floor
// scatters upwards is estimated by next-event estimation and compared with the configuration factor of a square.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "isophote/sampling/sampler.h"
#include "isophote/scene/emitter.h"
#include "isophote/scene/scene.h"
#include "isophote/scene/surface.h"
#include "isophote/trace/path.h"
#include "isophote/trace/ray_caster.h"

namespace {

constexpr float albedo = 0.5f;

/// A square of half width 1 in the plane y = height, its front towards +y or, where `down`, towards -y.
isophote::Mesh square(float height, int material, bool down) {
  isophote::Mesh mesh;
  mesh.material = material;
  mesh.positions = {{-1, height, -1}, {-1, height, 1}, {1, height, 1}, {1, height, -1}};
  if (down)
    mesh.triangles = {{{0, 2, 1}}, {{0, 3, 2}}};
  else
    mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  return mesh;
}

isophote::Scene floor_and_lamp() {
  isophote::Scene scene;
  isophote::Material matte;
  matte.base_color = isophote::Rgb(albedo);
  matte.metallic = 0;
  matte.specular = 0;
  isophote::Material lamp = matte;
  lamp.base_color = isophote::Rgb(0.0f);
  lamp.emission = isophote::Rgb(1.0f);
  scene.materials = {matte, lamp};
  scene.meshes = {square(0, 0, false), square(1, 1, true)};
  return scene;
}

}  // namespace

int main() {
  const isophote::Scene scene = floor_and_lamp();
  const isophote::RayCaster rays(scene);
  const isophote::Emitters emitters(scene);
  const isophote::World world{scene, rays, emitters};

  const isophote::Ray ray{{0, 0.5f, 0}, {0, -1, 0}};
  isophote::Hit hit;
  if (!rays.intersect(ray, 0, hit)) return 1;
  const isophote::SurfacePoint point = isophote::surface_point(scene, ray, hit);
  const isophote::Vec3 up{0, 1, 0};

  constexpr int samples = 4096;
  double sum = 0, squares = 0;
  isophote::RayCounts counts;
  for (std::uint32_t i = 0; i < samples; ++i) {
    isophote::Sampler sampler(isophote::Purpose::test, 1, 0, i);
    const double radiance = isophote::scatter(world, point, up, 0, sampler, counts).direct.g;
    sum += radiance;
    squares += radiance * radiance;
  }
  const double mean = sum / samples, error = std::sqrt((squares / samples - mean * mean) / samples);

  // Four corners, each (1 / 2 pi) * 2 / sqrt(2) * atan(1 / sqrt(2)); scattered radiance is albedo / pi * pi F.
  const double factor = 4 / (std::numbers::pi * std::numbers::sqrt2) * std::atan(1 / std::numbers::sqrt2);
  const double expected = albedo * factor;
  std::printf("scattered radiance: %.4f +- %.4f, expected %.4f\n", mean, error, expected);
  return std::abs(mean - expected) <= 4 * error && error < 0.01 * expected ? 0 : 1;
}
