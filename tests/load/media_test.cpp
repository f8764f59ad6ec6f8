#include <cmath>

#include "isophote/load/scene_file.h"
#include "load/gltf_builder.h"
#include "support/scenes.h"

namespace isophote::testing {
namespace {

const Warn ignore = [](const std::string&) {};

/// A scene file and its glTF: a floor 4 m wide, and a brick in two places, whose nodes are "left" and "right".
class MediaFile : public ::testing::Test {
 protected:
  MediaFile() {
    builder_.node({{"mesh", mesh(scenes::box({-2, -0.5f, -2}, {2, 0, 2}, false, 0), "floor")}});
    const std::size_t brick = mesh(scenes::box({0, 0, 0}, {1, 2, 1}, true, 0), "brick");
    builder_.node({{"mesh", brick}, {"name", "left"}});
    builder_.node({{"mesh", brick}, {"name", "right"}, {"translation", {1.9, 0, 0}}, {"scale", {-0.5, 1, 1}}});
    builder_.node({{"mesh", mesh(scenes::box({0, 0, 0}, {1, 1, 1}, false, 0), "")}, {"name", "nameless"}});
    builder_.triangle();
    folder_.write("a.glb", builder_.glb());
  }

  std::size_t mesh(const Mesh& shape, const std::string& name) {
    std::vector<float> positions;
    for (const Vec3& p : shape.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    std::vector<std::uint16_t> indices;
    for (const auto& t : shape.triangles)
      for (const std::uint32_t id : t) indices.push_back(static_cast<std::uint16_t>(id));
    const std::size_t accessor = builder_.accessor(indices, "SCALAR", ushort_type, 1);
    return builder_.mesh({{"attributes", {{"POSITION", builder_.vec3(positions)}}}, {"indices", accessor}}, name);
  }

  LoadedScene load(const std::string& media) {
    return load_scene(folder_.write("a.toml", "[scene]\nfile = 'a.glb'\n" + media), ignore);
  }
  /// The message without the path of the scene file before it.
  std::string refusal(const std::string& media) {
    try {
      load(media);
    } catch (const UserError& error) {
      const std::string path = (folder_.path() / "a.toml").string(), message = error.what();
      return message.substr(0, path.size()) == path ? message.substr(path.size()) : message;
    }
    return "";
  }

  GltfBuilder builder_;
  TemporaryFolder folder_;
};

double volume(const ClosedMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]))) / 6;
  return sum;
}

TEST_F(MediaFile, WithoutBoundsItFillsTheScene) {
  const Scene scene = load("[[media]]\nname = 'fog'\nsigma_s = 0.5\ng = 0.25\nheight = {scale = 2}\n").scene;
  ASSERT_EQ(scene.media.size(), 1u);
  const Medium& fog = scene.media[0];
  EXPECT_EQ(fog.name, "fog");
  EXPECT_EQ(fog.scattering, Rgb(0.5f));
  EXPECT_EQ(fog.g, 0.25f);
  EXPECT_EQ(std::get<Box>(fog.bounds).lower, Vec3(-2, -0.5f, -2));
  EXPECT_EQ(std::get<Box>(fog.bounds).upper, Vec3(2, 2, 2));
  EXPECT_EQ(std::get<HeightDensity>(fog.density).base, 0);
  EXPECT_EQ(std::get<HeightDensity>(fog.density).height, 2);
  EXPECT_EQ(scene.meshes.size(), 5u);
}

TEST_F(MediaFile, MeshesBecomeBoundaries) {
  const Scene both = load("[[media]]\ndensity = 1\nmesh = 'brick'\n").scene;
  EXPECT_EQ(both.meshes.size(), 3u);
  EXPECT_EQ(std::get<ClosedMesh>(both.media[0].bounds).triangles.size(), 24u);
  EXPECT_NEAR(volume(std::get<ClosedMesh>(both.media[0].bounds)), 3, 1e-5);
  const Scene one = load("[[media]]\ndensity = 1\nmesh = 'right'\n").scene;
  EXPECT_EQ(one.meshes.size(), 4u);
  EXPECT_NEAR(volume(std::get<ClosedMesh>(one.media[0].bounds)), 1, 1e-5);
  const Scene shared =
      load("[[media]]\ndensity = 1\nmesh = 'nameless'\n[[media]]\ndensity = 1\nmesh = 'nameless'\n").scene;
  EXPECT_EQ(shared.meshes.size(), 4u);
  EXPECT_EQ(shared.media.size(), 2u);
  for (const Medium& m : shared.media) EXPECT_NEAR(volume(std::get<ClosedMesh>(m.bounds)), 1, 1e-5);
}

TEST_F(MediaFile, ErrorsNameTheirLine) {
  EXPECT_EQ(refusal("[[media]]\ndensity = 1\nmesh = 'jar'\n"), ":5: no mesh or node is called 'jar'");
  EXPECT_EQ(refusal("[[media]]\ndensity = 1\nmesh = 'mesh'\n").find(":5: mesh 'mesh' is not closed: its edge from ("),
            0u);
  EXPECT_EQ(refusal("[[media]]\ndensity = 1\ngrid = {file = 'smoke.vdb'}\n"),
            ":5: no file '" + (folder_.path() / "smoke.vdb").string() + "'");
  EXPECT_EQ(refusal("[[media]]\nsigma_a = 2\nheight = {scale = 0.02}\n"),
            ":3: [[media]] is too dense: sigma_t comes to 1.4401e+11/m, above 1e+09");
  EXPECT_EQ(refusal("[[media]]\nemission = 1e25\nheight = {scale = 0.02, base = 0.1}\n"),
            ":3: [[media]] is too bright: emission comes to 1.06865e+38, above 1e+30");
  std::string all_but_a_triangle;
  for (const char* name : {"floor", "brick", "nameless"})
    all_but_a_triangle += std::string("[[media]]\ndensity = 1\nmesh = '") + name + "'\n";
  EXPECT_EQ(refusal(all_but_a_triangle + "[[media]]\ndensity = 1\n"),
            ":12: [[media]] needs a box: what is to be seen encloses nothing");
}

}  // namespace
}  // namespace isophote::testing
