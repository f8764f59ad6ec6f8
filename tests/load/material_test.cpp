#include <cmath>

#include "isophote/scene/surface.h"
#include "load/material_builder.h"

namespace isophote::testing {
namespace {

Material only_material(const GltfBuilder& builder) { return load(builder).materials.at(0); }

TEST(GltfMaterial, DefaultsAreThoseOfTheFormat) {
  GltfBuilder builder;
  builder.triangle();
  const Scene scene = load(builder);
  ASSERT_EQ(scene.meshes[0].material, 0);
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.base_color, Rgb(1.0f));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emission, Rgb(0.0f));
  EXPECT_EQ(m.alpha, Alpha::opaque);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.transmission, 0);
  EXPECT_EQ(m.attenuation_distance, infinity);
  EXPECT_FALSE(m.double_sided || m.solid);
}

TEST(GltfMaterial, TheDefaultMaterialStandsBehindTheOthers) {
  MaterialBuilder builder;
  builder.triangle();
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.meshes[0].material, 0);
  EXPECT_EQ(scene.meshes[1].material, 1);
}

TEST(GltfMaterial, FactorsAndExtensions) {
  MaterialBuilder builder;
  builder.material() = json::parse(R"({
    "name": "all", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25, "emissiveFactor": [1, 0.5, 0],
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.005},
    "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": 8},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 2, 0.5]},
      "KHR_materials_ior": {"ior": 1.33},
      "KHR_materials_transmission": {"transmissionFactor": 0.75},
      "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 10000000000, "attenuationColor": [0.5, 0.6, 0.7]}}})");
  const Material m = only_material(builder);
  EXPECT_EQ(m.name, "all");
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.alpha, Alpha::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_EQ(m.base_color, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.base_alpha, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.005f);
  EXPECT_EQ(m.emission, Rgb(8, 4, 0));
  EXPECT_EQ(m.specular, 0.5f);
  EXPECT_EQ(m.specular_color, Rgb(1, 2, 0.5f));
  EXPECT_EQ(m.ior, 1.33f);
  EXPECT_EQ(m.transmission, 0.75f);
  EXPECT_TRUE(m.solid);
  EXPECT_EQ(m.attenuation_color, Rgb(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(m.attenuation_distance, 1e10f);  // an integer of more than 32 bits
}

// KHR_materials_ior: 0 stands for infinity, so that the Fresnel term is 1 at all angles.
TEST(GltfMaterial, IorOfZeroReflectsAllAtAllAngles) {
  MaterialBuilder builder;
  builder.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
  builder.extension("KHR_materials_ior") = {{"ior", 0}};
  builder.extension("KHR_materials_specular") = {{"specularColorFactor", {0.5, 1, 1}}};
  const auto seen = [&] { return surface_point(load(builder), {{0, 0, 1}, {0, 0, -1}}, {0, 0, 0.3f, 0.3f, 1}).bsdf; };
  EXPECT_EQ(seen().f0, Rgb(0.5f, 1, 1));
  EXPECT_EQ(seen().f90, 1);
  builder.extension("KHR_materials_transmission") = {{"transmissionFactor", 1}};
  builder.extension("KHR_materials_volume") = {{"thicknessFactor", 1}};
  builder.material()["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  for (const float cosine : {1.0f, 0.5f, 0.01f}) {
    const Rgb albedo = specular_albedo(seen(), cosine);
    EXPECT_NEAR(albedo.r, 0.5f, 1e-5f) << cosine;
    EXPECT_NEAR(albedo.g, 1, 1e-5f) << cosine;
  }
}

TEST(GltfMaterial, GlassOfAHighIndexReflectsNoNegativeLight) {
  MaterialBuilder builder;
  builder.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0}};
  builder.extension("KHR_materials_ior") = {{"ior", 1000}};
  builder.extension("KHR_materials_specular") = {{"specularColorFactor", {0.5, 1, 1}}};
  builder.extension("KHR_materials_transmission") = {{"transmissionFactor", 1}};
  const Bsdf bsdf = surface_point(load(builder), {{0, 0, 1}, {0, 0, -1}}, {0, 0, 0.3f, 0.3f, 1}).bsdf;
  for (const float cosine : {1.0f, 0.1f, 0.01f, 0.001f}) EXPECT_GE(specular_albedo(bsdf, cosine).r, 0) << cosine;
}

TEST(GltfMaterial, VolumeWithoutThicknessIsASheet) {
  MaterialBuilder builder;
  builder.extension("KHR_materials_volume") = {{"thicknessFactor", 0}};
  EXPECT_FALSE(only_material(builder).solid);
}

TEST(GltfMaterial, EachTextureHasItsEncoding) {
  MaterialBuilder builder;
  builder.material() = json::parse(R"({
    "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}, "roughnessFactor": 0},
    "normalTexture": {"index": 1, "scale": 0.5}, "emissiveTexture": {"index": 1},
    "extensions": {"KHR_materials_specular": {"specularTexture": {"index": 0, "texCoord": 1}, "specularColorTexture": {"index": 0}},
                   "KHR_materials_transmission": {"transmissionTexture": {"index": 1}}}})");
  const Scene scene = load(builder);
  const Material& m = scene.materials[0];
  const auto texture = [&](const TextureUse& use) -> const Texture& {
    return scene.textures.at(static_cast<std::size_t>(use.texture));
  };
  for (const TextureUse* use : {&m.base_color_texture, &m.emission_texture, &m.specular_color_texture})
    EXPECT_TRUE(texture(*use).srgb);
  for (const TextureUse* use :
       {&m.metallic_roughness_texture, &m.normal_texture, &m.specular_texture, &m.transmission_texture})
    EXPECT_FALSE(texture(*use).srgb);
  EXPECT_EQ(scene.textures.size(), 4u);  // two samplers, both encodings
  EXPECT_EQ(m.base_color_texture.texture, m.specular_color_texture.texture);
  EXPECT_EQ(m.normal_scale, 0.5f);
  EXPECT_EQ(m.specular_texture.uv_set, 1);
  EXPECT_EQ(texture(m.base_color_texture).wrap_u, Wrap::repeat);
  EXPECT_EQ(texture(m.normal_texture).wrap_u, Wrap::clamp);
  EXPECT_EQ(texture(m.normal_texture).wrap_v, Wrap::mirror);
  EXPECT_EQ(texture(m.base_color_texture).rgba, (Bytes{0, 64, 128, 255, 255, 32, 16, 0}));
  EXPECT_EQ(texture(m.base_color_texture).width, 2);
  EXPECT_EQ(texture(m.base_color_texture).name, "picture");
}

TEST(GltfMaterial, TextureTransformScalesThenTurnsThenMoves) {
  MaterialBuilder builder;
  const double angle = 0.5;
  builder.material()["emissiveTexture"] = {
      {"index", 0},
      {"texCoord", 0},
      {"extensions",
       {{"KHR_texture_transform", {{"offset", {0.1, 0.2}}, {"rotation", angle}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
  const TextureUse use = only_material(builder).emission_texture;
  EXPECT_EQ(use.uv_set, 1);
  // Counter-clockwise as one sees it with v pointing down: a quarter turn takes (1, 0) to (0, -1).
  const double c = std::cos(angle), s = std::sin(angle), u = 0.7, v = -0.4;
  const double expected_u = c * (2 * u) + s * (3 * v) + 0.1, expected_v = -s * (2 * u) + c * (3 * v) + 0.2;
  EXPECT_NEAR(use.matrix[0] * u + use.matrix[1] * v + use.matrix[2], expected_u, 1e-6);
  EXPECT_NEAR(use.matrix[3] * u + use.matrix[4] * v + use.matrix[5], expected_v, 1e-6);
}

TEST(GltfMaterial, TextureTransformInsideAnExtension) {
  MaterialBuilder builder;
  builder.extension("KHR_materials_specular") = {
      {"specularColorTexture",
       {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.25, 0}}, {"texCoord", 1}}}}}}}};
  const TextureUse use = only_material(builder).specular_color_texture;
  EXPECT_EQ(use.uv_set, 1);
  EXPECT_EQ(use.matrix, (std::array<float, 6>{1, 0, 0.25f, 0, 1, 0}));
}

TEST(GltfMaterial, TextureCoordinatesAreReadWhereTheyAreNeeded) {
  MaterialBuilder builder;
  EXPECT_TRUE(load(builder).meshes[0].uv[0].empty());
  builder.material()["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  const Scene scene = load(builder);
  EXPECT_TRUE(scene.meshes[0].uv[0].empty());
  EXPECT_EQ(scene.meshes[0].uv[1], (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  builder.primitive()["attributes"]["TEXCOORD_1"] =
      builder.accessor(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 13107}, "VEC2", ushort_type, 2);
  EXPECT_EQ(load(builder).meshes[0].uv[1][2], (Vec2{0, 0.2f}));
  builder.primitive()["attributes"].erase("TEXCOORD_1");
  const Loaded loaded = try_load(builder);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("lacks TEXCOORD_1"), std::string::npos);
}

TEST(GltfMaterial, FactorsOutsideTheirRangeAreClampedAndReported) {
  MaterialBuilder builder;
  builder.material()["pbrMetallicRoughness"] = {{"baseColorFactor", {2, 0.5, -1, 1}}};
  const Loaded loaded = try_load(builder);
  EXPECT_EQ(loaded.scene.materials.at(0).base_color, Rgb(1, 0.5f, 0));
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{
                "test.gltf: materials[0] \"paint\": baseColorFactor lies outside [0, 1] and is clamped"});
}

TEST(GltfMaterial, RoughTransmissionWarns) {
  MaterialBuilder builder;
  builder.extension("KHR_materials_transmission") = {{"transmissionFactor", 1}};
  const auto warnings = [&](double roughness, bool textured) {
    builder.material()["pbrMetallicRoughness"] = {{"roughnessFactor", roughness}};
    if (textured) builder.material()["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    return try_load(builder).warnings;
  };
  const std::vector<std::string> rough{"test.gltf: materials[0] \"paint\": rough transmission is rendered smooth"};
  EXPECT_EQ(warnings(0.01, false), std::vector<std::string>{});
  EXPECT_EQ(warnings(0.02, false), rough);
  EXPECT_EQ(warnings(0, true), rough);
}

}  // namespace
}  // namespace isophote::testing
