#include "load/gltf_builder.h"

namespace isophote::testing {
namespace {

Vec3 face_normal(const Mesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  return normalize(cross(b - a, c - a));
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  EXPECT_LE(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " "
                                      << b.z;
}

TEST(GltfGeometry, TriangleHasNoOptionalAttributes) {
  GltfBuilder builder;
  builder.triangle();
  const Scene scene = load(builder);
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.name, "mesh");
  EXPECT_TRUE(mesh.normals.empty() && mesh.tangents.empty() && mesh.uv[0].empty() && mesh.uv[1].empty() &&
              mesh.colors.empty());
}

TEST(GltfGeometry, TransformsComposeFromRootToLeaf) {
  GltfBuilder builder;
  builder.triangle();
  // The parent turns +90 degrees about Z, the child scales, then moves: (1,0,0) -> (2,0,0) -> (12,0,0) -> (0,12,0).
  const double h = std::sqrt(0.5);
  builder.document["nodes"] = {{{"rotation", {0, 0, h, h}}, {"children", {1}}},
                               {{"mesh", 0}, {"translation", {10, 0, 0}}, {"scale", {2, 3, 4}}}};
  const Scene scene = load(builder);
  const auto& p = scene.meshes.at(0).positions;
  expect_near(p[0], {0, 10, 0}, 1e-5f);
  expect_near(p[1], {0, 12, 0}, 1e-5f);
  expect_near(p[2], {-3, 10, 0}, 1e-5f);
}

TEST(GltfGeometry, MatrixAndItsPartsAgree) {
  GltfBuilder builder;
  builder.triangle();
  // A quaternion of length 2 stands for the same rotation.
  builder.document["nodes"] = {
      {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {1, 1, 1, 1}}, {"scale", {2, 2, 2}}},
      {{"mesh", 0}, {"matrix", {0, 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 1, 2, 3, 1}}}};
  builder.document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = load(builder);
  for (std::size_t i = 0; i < 3; ++i) expect_near(scene.meshes[0].positions[i], scene.meshes[1].positions[i]);
  expect_near(scene.meshes[1].positions[1], {1, 4, 3});
}

TEST(GltfGeometry, InstancesAreCopied) {
  GltfBuilder builder;
  builder.triangle();
  builder.node({{"mesh", 0}, {"translation", {0, 0, 5}}});
  const Scene scene = load(builder);
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.meshes[1].positions[0], (Vec3{0, 0, 5}));
}

TEST(GltfGeometry, OnlyTheDefaultSceneIsLoaded) {
  GltfBuilder builder;
  builder.triangle();
  builder.append("nodes", {{"mesh", 0}, {"translation", {7, 0, 0}}});
  builder.append("scenes", {{"nodes", {1}}});
  builder.document["scene"] = 1;
  const Scene scene = load(builder);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].positions[0].x, 7.0f);
}

TEST(GltfGeometry, MirrorsKeepFrontAndNormalsTogether) {
  GltfBuilder builder;
  json& primitive = builder.triangle();
  primitive["attributes"]["NORMAL"] = builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  for (const json& scale : {json{-1, 1, 1}, json{1, 1, -1}, json{-2, -3, 1}, json{-1, -1, -1}}) {
    builder.document["nodes"][0]["scale"] = scale;
    const Scene scene = load(builder);
    EXPECT_GT(dot(face_normal(scene.meshes[0], 0), scene.meshes[0].normals[0]), 0.999f) << scale.dump();
    EXPECT_EQ(scene.meshes[0].normals[0].z, scale[2].get<float>() < 0 ? -1.0f : 1.0f) << scale.dump();
  }
}

TEST(GltfGeometry, NormalsGoByTheInverseTranspose) {
  GltfBuilder builder;
  const float s = std::sqrt(0.5f);
  // The plane x + y = 1, squeezed along x by 4: 4x + y = 1.
  const std::size_t positions = builder.vec3({1, 0, 0, 0, 1, 0, 1, 0, -1}),
                    normals = builder.vec3({s, s, 0, s, s, 0, s, s, 0});
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})},
                {"scale", {0.25, 1, 1}}});
  const Scene scene = load(builder);
  const Vec3 expected = normalize(Vec3{4, 1, 0});
  expect_near(scene.meshes[0].normals[0], expected);
  EXPECT_NEAR(std::abs(dot(face_normal(scene.meshes[0], 0), expected)), 1, 1e-6);
}

TEST(GltfGeometry, TangentsAreReadWhereANormalMapNeedsThem) {
  GltfBuilder builder;
  json& primitive = builder.triangle();
  primitive["attributes"]["NORMAL"] = builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  primitive["attributes"]["TANGENT"] =
      builder.accessor(std::vector<float>{1, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, 1}, "VEC4", float_type, 4);
  EXPECT_TRUE(load(builder).meshes[0].tangents.empty());

  primitive = builder.primitive();
  primitive["attributes"]["TEXCOORD_0"] = builder.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", float_type, 2);
  primitive["material"] = 0;
  builder.document["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  builder.document["textures"] = {{{"source", 0}}};
  builder.document["images"] = {
      {{"uri",
        "data:image/"
        "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg="
        "="}}};
  builder.document["nodes"][0]["scale"] = {-2, 1, 1};
  const Mesh mesh = load(builder).meshes.at(0);
  // The mirror image of T is -X; of the bitangent sign * N x T it is +Y * sign: the sign turns.
  EXPECT_EQ(mesh.tangents[0], (Vec3{-1, 0, 0}));
  EXPECT_EQ(mesh.tangent_signs, (std::vector<float>{-1, 1, -1}));
}

template <class T>
std::vector<std::array<std::uint32_t, 3>> triangles_with_indices(const std::vector<T>& indices, int component,
                                                                 int mode) {
  GltfBuilder builder;
  const std::size_t positions = builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}},
                                       {"mode", mode},
                                       {"indices", builder.accessor(indices, "SCALAR", component, 1)}})}});
  return load(builder).meshes.at(0).triangles;
}

TEST(GltfGeometry, IndicesOfEveryWidth) {
  const std::vector<std::array<std::uint32_t, 3>> expected{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  EXPECT_EQ(triangles_with_indices<std::uint8_t>({0, 1, 2, 1, 3, 2, 2, 3, 4}, ubyte_type, 4), expected);
  EXPECT_EQ(triangles_with_indices<std::uint16_t>({0, 1, 2, 1, 3, 2, 2, 3, 4}, ushort_type, 4), expected);
  EXPECT_EQ(triangles_with_indices<std::uint32_t>({0, 1, 2, 1, 3, 2, 2, 3, 4}, uint_type, 4), expected);
}

TEST(GltfGeometry, StripsAndFansKeepTheirWinding) {
  EXPECT_EQ(triangles_with_indices<std::uint8_t>({0, 1, 2, 3, 4}, ubyte_type, 5),
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles_with_indices<std::uint8_t>({0, 1, 3, 4}, ubyte_type, 6),
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));  // vertex 2 is not used and left out
}

TEST(GltfGeometry, VerticesThatNoTriangleUsesAreLeftOut) {
  GltfBuilder builder;
  const float nan = std::nanf("");
  const std::size_t positions = builder.vec3({nan, nan, nan, 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0});
  const std::size_t colors = builder.vec3({.1f, .1f, .1f, .2f, .2f, .2f, .3f, .3f, .3f, .4f, .4f, .4f, .5f, .5f, .5f});
  const std::size_t indices = builder.accessor(std::vector<std::uint8_t>{1, 3, 4}, "SCALAR", ubyte_type, 1);
  builder.node(
      {{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}}, {"indices", indices}})}});
  const Mesh mesh = load(builder).meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  ASSERT_EQ(mesh.colors.size(), 3u);
  EXPECT_EQ(mesh.colors[1].color, Rgb(.4f));
  EXPECT_EQ(mesh.colors[1].alpha, 1.0f);
}

TEST(GltfGeometry, InterleavedViewsAndByteStrides) {
  GltfBuilder builder;
  // Position, normal and padding, 28 bytes a vertex.
  const std::vector<float> data{0, 0, 0, 0, 0, 1, 99, 1, 0, 0, 0, 0, 1, 99, 0, 1, 0, 0, 0, 1, 99};
  const std::size_t view = builder.view(data, 28);
  const json attributes = {{"POSITION", builder.accessor(view, "VEC3", float_type, 3)},
                           {"NORMAL", builder.accessor(view, "VEC3", float_type, 3, 12)}};
  builder.node({{"mesh", builder.mesh({{"attributes", attributes}})}});
  const Mesh mesh = load(builder).meshes.at(0);
  EXPECT_EQ(mesh.positions[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>(3, {0, 0, 1})));
}

TEST(GltfGeometry, SparseAccessorsReplaceElements) {
  for (const bool on_zeros : {false, true}) {
    GltfBuilder builder;
    json& primitive = builder.triangle();
    const std::size_t indices = builder.view(std::vector<std::uint16_t>{1, 2}),
                      values = builder.view(std::vector<float>{5, 0, 0, 0, 6, 0});
    json& accessor = builder.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", indices}, {"componentType", ushort_type}}},
                          {"values", {{"bufferView", values}}}};
    if (on_zeros) accessor.erase("bufferView"), accessor.erase("byteOffset");
    EXPECT_EQ(load(builder).meshes.at(0).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
  }
}

TEST(GltfGeometry, ColorsOfEveryType) {
  const auto color_of = [](auto values, const char* type, int component, std::size_t per) {
    GltfBuilder builder;
    json& primitive = builder.triangle();
    primitive["attributes"]["COLOR_0"] = builder.accessor(values, type, component, per);
    return load(builder).meshes.at(0).colors.at(1);
  };
  const Rgba floats = color_of(std::vector<float>{0, 0, 0, .25f, .5f, 1, 0, 0, 0}, "VEC3", float_type, 3);
  EXPECT_EQ(floats.color, Rgb(.25f, .5f, 1));
  EXPECT_EQ(floats.alpha, 1);
  const Rgba shorts =
      color_of(std::vector<std::uint16_t>{0, 0, 0, 0, 65535, 0, 13107, 32768, 0, 0, 0, 0}, "VEC4", ushort_type, 4);
  EXPECT_EQ(shorts.color, Rgb(1, 0, .2f));
  EXPECT_EQ(shorts.alpha, 32768 / 65535.0f);
  const Rgba bytes =
      color_of(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 51, 0, 102, 0, 0, 0, 0}, "VEC4", ubyte_type, 4);
  EXPECT_EQ(bytes.color, Rgb(1, .2f, 0));
  EXPECT_EQ(bytes.alpha, .4f);
}

TEST(GltfGeometry, DegenerateTrianglesAreCountedOnce) {
  GltfBuilder builder;
  const std::size_t positions = builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0});
  // A sound one, one that names a vertex twice, and three points in a row.
  const std::size_t indices =
      builder.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 0, 1, 0, 1, 3}, "SCALAR", ubyte_type, 1);
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  builder.node({{"mesh", 0}});
  const Loaded loaded = try_load(builder);
  EXPECT_EQ(loaded.scene.triangle_count(), 2u);
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"test.gltf: 4 degenerate triangles are left out"});
}

TEST(GltfGeometry, LeftOutPartsWarnAndTheRestLoads) {
  GltfBuilder builder;
  builder.triangle();
  const std::size_t row = builder.vec3({0, 0, 0, 1, 0, 0, 2, 0, 0});
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", row}}}, {"mode", 1}}, "lines")}});
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", row}}}}, "flat")}});
  builder.node({{"mesh", builder.mesh({{"attributes", {{"NORMAL", row}}}}, "nothing")}});
  const Loaded loaded = try_load(builder);
  EXPECT_EQ(loaded.error, "");
  EXPECT_EQ(loaded.scene.meshes.size(), 1u);
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{
                                 "test.gltf: meshes[1] \"lines\": primitives[0]: is skipped: mode 1 is not triangles",

                                 "test.gltf: meshes[3] \"nothing\": primitives[0]: is skipped: it has no POSITION",
                                 "test.gltf: 1 degenerate triangles are left out",
                                 "test.gltf: 1 primitives without a triangle are left out"}));
}

TEST(GltfGeometry, NormalsWithoutDirectionMeanFlat) {
  for (const float bad : {0.0f, std::nanf("")}) {
    GltfBuilder builder;
    json& primitive = builder.triangle();
    primitive["attributes"]["NORMAL"] = builder.vec3({0, 0, 1, 0, 0, bad, 0, 0, 1});
    const Loaded loaded = try_load(builder);
    EXPECT_TRUE(loaded.scene.meshes.at(0).normals.empty());
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].find("normals without a direction"), std::string::npos);
  }
}

TEST(GltfGeometry, IgnoredFeaturesWarnOnceEach) {
  GltfBuilder builder;
  json& primitive = builder.triangle();
  primitive["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
  builder.document["skins"] = {{{"joints", {0}}}, {{"joints", {0}}}};
  builder.document["animations"] = {{{"channels", json::array()}}};
  builder.document["extensionsUsed"] = {"VENDOR_a", "VENDOR_b", "VENDOR_a", "KHR_materials_ior"};
  const Loaded loaded = try_load(builder);
  EXPECT_EQ(loaded.error, "");
  EXPECT_EQ(loaded.warnings.size(), 5u);  // two extensions, animations, skins, morph targets
}

}  // namespace
}  // namespace isophote::testing
