#include <cstdint>
#include <string>

#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/load/gltf_bytes.h"

using namespace isophote;

namespace {

/// What scene.h promises of a loaded scene.
void check_scene(const Scene& scene) {
  ISOPHOTE_CHECK(scene.cameras.empty(), ==, false);
  for (const Mesh& mesh : scene.meshes) {
    const std::size_t vertices = mesh.positions.size();
    ISOPHOTE_CHECK(static_cast<std::size_t>(mesh.material), <, scene.materials.size());
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t id : triangle) ISOPHOTE_CHECK(id, <, vertices);
    for (const Vec3& p : mesh.positions) ISOPHOTE_CHECK(is_finite(p), ==, true);
    for (const Vec3& n : mesh.normals) ISOPHOTE_CHECK(std::abs(length(n) - 1), <, 1e-5f);
    for (const std::size_t size : {mesh.normals.size(), mesh.tangents.size(), mesh.tangent_signs.size(),
                                   mesh.uv[0].size(), mesh.uv[1].size(), mesh.colors.size()})
      if (size != 0) ISOPHOTE_CHECK(size, ==, vertices);
  }
  for (const Material& material : scene.materials)
    ISOPHOTE_CHECK(material.base_color_texture.texture, <, static_cast<int>(scene.textures.size()));
  for (const Texture& texture : scene.textures)
    ISOPHOTE_CHECK(texture.rgba.size(), ==,
                   std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t memory = 64 << 20;
  try {
    check_scene(load_gltf_bytes({data, size}, "fuzz.gltf", "no-such-folder", memory, [](const std::string&) {}));
  } catch (const UserError& error) {
    ISOPHOTE_CHECK(std::string(error.what()).find('\n'), ==, std::string::npos);
  }
  return 0;
}
