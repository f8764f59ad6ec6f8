// Loads any bytes as glTF; of a scene that is accepted, surfaces are looked at and lights are sampled.
#include <cstdint>
#include <string>

#include "fuzz/scene_checks.h"
#include "isophote/core/error.h"
#include "isophote/load/gltf_bytes.h"
#include "isophote/scene/punctual_lights.h"
#include "isophote/scene/surface.h"

using namespace isophote;

namespace {

// The work on one input is bounded.
constexpr std::size_t most_triangles = 300, most_lights = 300, most_hits = 32;

void check_surface(const Scene& scene, const Ray& ray, const Hit& hit) {
  const SurfacePoint point = surface_point(scene, ray, hit);
  ISOPHOTE_CHECK(is_finite(point.position), ==, true);
  for (const Vec3& n : {point.geometric_normal, point.shading_normal, point.bsdf.frame.n})
    ISOPHOTE_CHECK(fuzz::is_unit(n), ==, true);
  ISOPHOTE_CHECK(dot(point.bsdf.frame.n, -ray.direction), >, 0);
  for (const Rgb& c : {point.bsdf.diffuse, point.bsdf.f0, point.bsdf.transmission})
    ISOPHOTE_CHECK(fuzz::in_unit(c), ==, true);
  ISOPHOTE_CHECK(point.bsdf.eta > 0 && std::isfinite(point.bsdf.eta), ==, true);
  ISOPHOTE_CHECK(fuzz::is_sound(point.emission) && fuzz::is_sound(point.attenuation), ==, true);
  ISOPHOTE_CHECK(fuzz::in_unit(opacity(scene, hit)), ==, true);
  ISOPHOTE_CHECK(fuzz::is_sound(emission(scene, hit)), ==, true);

  const LobeChances chances = lobe_chances(point.bsdf, -ray.direction);
  for (const float chance : {chances.diffuse, chances.glossy, chances.specular})
    ISOPHOTE_CHECK(fuzz::in_unit(chance), ==, true);
}

/// Light may be infinite where a lamp is met at no distance, but neither negative nor not a number.
void check_light(const LightSample& sample) {
  ISOPHOTE_CHECK(sample.pdf, >=, 0);
  if (sample.pdf == 0) return;
  ISOPHOTE_CHECK(fuzz::is_unit(sample.direction), ==, true);
  ISOPHOTE_CHECK(std::min({sample.radiance.r, sample.radiance.g, sample.radiance.b}), >=, 0);
}

void check_emitters(const Emitters& emitters, const Vec3& from) {
  for (int i = 0; i < 4; ++i) {
    const float u = static_cast<float>(i) / 4;
    if (!emitters.empty()) check_light(emitters.sample(from, u, {0.3f, 0.6f}));
    const PunctualLights& punctual = emitters.punctual(PunctualKinds::all);
    for (int k = 0; k < punctual.samples(); ++k) check_light(punctual.sample(k, from, u));
  }
}

void use(const Scene& scene) {
  if (scene.triangle_count() > most_triangles || scene.lights.size() > most_lights) return;
  const Emitters emitters(scene);
  std::size_t hits = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    for (std::uint32_t t = 0; t < scene.meshes[m].triangles.size() && hits < most_hits; ++t, ++hits) {
      const auto& ids = scene.meshes[m].triangles[t];
      const Vec3 middle = (scene.meshes[m].positions[ids[0]] + scene.meshes[m].positions[ids[1]]) * 0.5f;
      for (const Vec3& direction : {Vec3{0, 0, -1}, normalize(Vec3{3, -2, 1})})
        for (const Vec2& at : {Vec2{0.3f, 0.3f}, Vec2{0, 0}, Vec2{0.5f, 0.5f}})
          check_surface(scene, {middle, direction}, {m, t, at.x, at.y, 1});
      check_emitters(emitters, middle);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t memory = 64 << 20;
  try {
    const Scene scene = load_gltf_bytes({data, size}, "fuzz.gltf", "no-such-folder", memory, [](const std::string&) {});
    fuzz::check_scene(scene);
    use(scene);
  } catch (const UserError& error) {
    ISOPHOTE_CHECK(std::string(error.what()).find('\n'), ==, std::string::npos);
  }
  return 0;
}
