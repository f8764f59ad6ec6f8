#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "isophote/load/gltf.h"

namespace isophote {
namespace {

/// A scene by others, beside the repository where there are any, and what of it has no area.
struct Described {
  std::string name;
  std::size_t triangles_without_area = 0, meshes_without_area = 0;
};
class SharedScene : public ::testing::TestWithParam<Described> {};

Vec3 vec3(const nlohmann::json& v) { return {v[0].get<float>(), v[1].get<float>(), v[2].get<float>()}; }

TEST_P(SharedScene, AgreesWithItsDescription) {
  const std::string& name = GetParam().name;
  const std::filesystem::path folder = std::filesystem::path(ISOPHOTE_SOURCE_DIR) / "../shared/scenes" / name;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/scenes/" << name;
  const auto described = nlohmann::json::parse(std::ifstream(folder / (name + ".json")));
  const Scene scene = load_gltf((folder / (name + ".glb")).string(), [](const std::string&) {});

  EXPECT_EQ(scene.triangle_count() + GetParam().triangles_without_area, described["triangles"].get<std::size_t>());
  EXPECT_EQ(scene.meshes.size() + GetParam().meshes_without_area, described["meshes"].get<std::size_t>());
  EXPECT_EQ(scene.materials.size(), described["materials"].get<std::size_t>());
  EXPECT_EQ(scene.textures.size(), described["textures"].get<std::size_t>());
  std::size_t emissive = 0;
  for (const Mesh& mesh : scene.meshes)
    if (!is_black(scene.materials[static_cast<std::size_t>(mesh.material)].emission)) emissive += mesh.triangles.size();
  EXPECT_EQ(emissive, described["emissive_triangles"].get<std::size_t>());

  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  const auto& view = described["camera"];
  constexpr float rounding = 2e-5f;  // of the description
  EXPECT_LT(length(camera.eye - vec3(view["position"])), rounding);
  EXPECT_LT(length(camera.forward - normalize(vec3(view["look_at"]) - vec3(view["position"]))), rounding);
  EXPECT_LT(length(camera.up - vec3(view["up"])), rounding);
  EXPECT_NEAR(camera.fov_y * 180 / pi, view["fov_y_deg"].get<double>(), 1e-3);
  EXPECT_NEAR(camera.aspect, view["width"].get<double>() / view["height"].get<double>(), 1e-6);
  const Box bounds = scene.bounds();
  constexpr float bounds_rounding = 1e-3f;
  EXPECT_LT(length(bounds.lower - vec3(described["bbox"][0])), bounds_rounding);
  EXPECT_LT(length(bounds.upper - vec3(described["bbox"][1])), bounds_rounding);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedScene,
                         ::testing::Values(Described{"cornell-box"}, Described{"staircase", 155, 20},
                                           Described{"volumetric-caustic"}),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace isophote
