#include "isophote/scene/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace isophote {
namespace {

/// A unit square in z = 0 facing +z, hit at its first triangle from `from`.
struct Square {
  Scene scene;
  Hit hit{0, 0, 0.25f, 0.5f, 1};

  explicit Square(const Material& material) {
    scene.meshes.push_back(scenes::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, scenes::add(scene, material)));
  }
  Mesh& mesh() { return scene.meshes[0]; }
  Material& material() { return scene.materials[0]; }
  int add_texel(std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a) {
    Texture texture;
    texture.width = texture.height = 1;
    texture.rgba = {r, g, b, a};
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
  }
  SurfacePoint from(const Vec3& direction) const { return surface_point(scene, {{}, normalize(direction)}, hit); }
};

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

/// Too small to stay off the edges by more than rounding, or hit exactly on an edge or corner: finite, and near.
TEST(SurfacePoint, SmallTrianglesAndTheirEdges) {
  for (const float size : {1e-7f, 1e-5f, 1.0f}) {
    Square square(scenes::diffuse(Rgb(0.5f)));
    for (Vec3& p : square.mesh().positions) p = Vec3{3, 4, 5} + p * size;
    for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{0.5f, 0.5f}, Vec2{0, 0.5f}, Vec2{0.3f, 0.3f}})
      for (const Vec3& from : {Vec3{1, 0, -1}, Vec3{-1, 0, -1}, Vec3{1, -1, -0.1f}, Vec3{-1, 1, 1}, Vec3{0, 0, -1}}) {
        square.hit.u = uv.x, square.hit.v = uv.y;
        const Vec3 position = square.from(from).position;
        ASSERT_TRUE(is_finite(position)) << size << " " << uv.x << " " << uv.y;
        EXPECT_LT(length(position - Vec3{3, 4, 5}), 2 * size + 1e-5f);
      }
  }
}

TEST(SurfacePoint, FacesTheRay) {
  const Square square(scenes::diffuse(Rgb(0.5f)));
  const SurfacePoint above = square.from({0, 0.3f, -1}), below = square.from({0, 0.3f, 1});
  // Corners (0,0), (1,0), (1,1) with weights 1/4, 1/4, 1/2.
  expect_near(above.position, {0.75f, 0.5f, 0}, 4e-6f);  // pulled off edges and back along the ray
  EXPECT_TRUE(above.front);
  EXPECT_FALSE(below.front);
  for (const Vec3& n : {above.geometric_normal, above.shading_normal, above.bsdf.frame.n}) expect_near(n, {0, 0, 1});
  for (const Vec3& n : {below.geometric_normal, below.shading_normal, below.bsdf.frame.n}) expect_near(n, {0, 0, -1});
}

TEST(SurfacePoint, InterpolatesNormalsOnEitherSide) {
  Square square(scenes::diffuse(Rgb(0.5f)));
  const Vec3 tilted = normalize(Vec3{0.3f, 0, 1});
  square.mesh().normals.assign(4, tilted);
  expect_near(square.from({0, 0, -1}).shading_normal, tilted);
  expect_near(square.from({0, 0, 1}).shading_normal, -tilted);
  // Normals authored against the winding are turned about.
  square.mesh().normals.assign(4, -tilted);
  expect_near(square.from({0, 0, -1}).shading_normal, tilted);
}

TEST(SurfacePoint, MappedNormalAlwaysFacesTheViewer) {
  Square square(scenes::diffuse(Rgb(0.5f)));
  const Vec3 tilted = normalize(Vec3{1, 0, 0.2f});
  square.mesh().normals.assign(4, tilted);
  const Vec3 direction = normalize(Vec3{1, 0, -0.1f});  // wo is behind the tilted normal
  const SurfacePoint point = square.from(direction);
  EXPECT_LT(dot(tilted, -direction), 0);
  EXPECT_GT(dot(point.bsdf.frame.n, -direction), 0);
  EXPECT_LT(dot(point.bsdf.frame.n, -direction), 0.01f);
  expect_near(point.shading_normal, tilted);  // records do not depend on the viewer
}

TEST(SurfacePoint, NormalMapTiltsAlongTheTexture) {
  Square square(scenes::diffuse(Rgb(0.5f)));
  square.material().normal_texture.texture = square.add_texel(255, 128, 128, 255);
  // All x: along growing u, here +x. (0 is between the codes 127 and 128.)
  expect_near(square.from({-1, 0, -1}).bsdf.frame.n, {1, 0, 0}, 0.01f);
  expect_near(square.from({-1, 0, -1}).shading_normal, {0, 0, 1});
  // Green points up in the picture, against growing v, here -y.
  square.scene.textures[0].rgba = {128, 255, 128, 255};
  expect_near(square.from({0, 1, -1}).bsdf.frame.n, {0, -1, 0}, 0.01f);
  // Given tangents win over derived ones.
  square.mesh().tangents.assign(4, {0, 1, 0});
  square.mesh().tangent_signs.assign(4, 1);
  expect_near(square.from({1, 0, -1}).bsdf.frame.n, {-1, 0, 0}, 0.01f);
  square.mesh().tangent_signs.assign(4, -1);
  expect_near(square.from({-1, 0, -1}).bsdf.frame.n, {1, 0, 0}, 0.01f);
}

TEST(SurfacePoint, NormalMapFollowsMirroredCoordinates) {
  Square square(scenes::diffuse(Rgb(0.5f)));
  square.material().normal_texture.texture = square.add_texel(255, 128, 128, 255);
  for (Vec2& uv : square.mesh().uv[0]) uv.x = -uv.x;
  expect_near(square.from({1, 0, -1}).bsdf.frame.n, {-1, 0, 0}, 0.01f);
  square.scene.textures[0].rgba = {128, 255, 128, 255};
  expect_near(square.from({0, 1, -1}).bsdf.frame.n, {0, -1, 0}, 0.01f);
}

TEST(SurfacePoint, NormalMapFollowsTheTextureTransform) {
  Square square(scenes::diffuse(Rgb(0.5f)));
  TextureUse& use = square.material().normal_texture;
  use.texture = square.add_texel(255, 128, 128, 255);
  use.matrix = {-1, 0, 0, 0, 1, 0};  // mirrored: u grows towards -x
  expect_near(square.from({1, 0, -1}).bsdf.frame.n, {-1, 0, 0}, 0.01f);
  use.matrix = {0, 1, 0, -1, 0, 0};  // turned: u grows towards +y, v towards -x
  expect_near(square.from({0, -1, -1}).bsdf.frame.n, {0, 1, 0}, 0.01f);
  square.scene.textures[0].rgba = {128, 255, 128, 255};
  expect_near(square.from({-1, 0, -1}).bsdf.frame.n, {1, 0, 0}, 0.01f);
  // Authored tangents are of the texture as it lies.
  square.mesh().tangents.assign(4, {0, -1, 0});
  square.mesh().tangent_signs.assign(4, 1);
  square.scene.textures[0].rgba = {255, 128, 128, 255};
  expect_near(square.from({0, 1, -1}).bsdf.frame.n, {0, -1, 0}, 0.01f);
}

TEST(SurfacePoint, MultipliesFactorsTexturesAndVertexColours) {
  Square square(scenes::diffuse({0.5f, 1, 1}));
  square.material().base_color_texture.texture = square.add_texel(255, 51, 255, 255);
  square.mesh().colors.assign(4, {{1, 1, 0.5f}, 1});
  const Rgb c = square.from({0, 0, -1}).bsdf.diffuse;
  EXPECT_FLOAT_EQ(c.r, 0.5f);
  EXPECT_FLOAT_EQ(c.g, 0.2f);
  EXPECT_FLOAT_EQ(c.b, 0.5f);
}

TEST(SurfacePoint, AppliesTheTextureTransform) {
  Square square(scenes::diffuse(Rgb(1.0f)));
  Texture texture;
  texture.width = 2, texture.height = 1;
  texture.rgba = {255, 255, 255, 255, 0, 0, 0, 255};
  square.scene.textures.push_back(texture);
  square.material().base_color_texture.texture = 0;
  square.material().base_color_texture.matrix = {0, 0, 0.25f, 0, 0, 0.5f};
  EXPECT_FLOAT_EQ(square.from({0, 0, -1}).bsdf.diffuse.r, 1);
  square.material().base_color_texture.matrix = {1, 0, 0, 0, 1, 0};  // u = 3/4
  EXPECT_FLOAT_EQ(square.from({0, 0, -1}).bsdf.diffuse.r, 0);
}

TEST(SurfacePoint, MetalAndDielectricReflectance) {
  Square square(scenes::metal({0.9f, 0.6f, 0.2f}, 0.5f));
  Bsdf bsdf = square.from({0, 0, -1}).bsdf;
  EXPECT_EQ(bsdf.f0, (Rgb{0.9f, 0.6f, 0.2f}));
  EXPECT_EQ(bsdf.f90, 1);
  EXPECT_EQ(bsdf.alpha, 0.25f);
  EXPECT_FALSE(bsdf.has_diffuse());
  square.material().metallic = 0;
  square.material().specular = 0.5f;
  square.material().specular_color = {1, 0.5f, 100};
  bsdf = square.from({0, 0, -1}).bsdf;
  EXPECT_NEAR(bsdf.f0.r, 0.02f, 1e-7);
  EXPECT_NEAR(bsdf.f0.g, 0.01f, 1e-7);
  EXPECT_NEAR(bsdf.f0.b, 0.5f, 1e-7);  // clamped before the factor
  EXPECT_EQ(bsdf.f90, 0.5f);
  EXPECT_EQ(bsdf.diffuse, (Rgb{0.9f, 0.6f, 0.2f}));
}

TEST(SurfacePoint, GlassKnowsItsSideAndAbsorbs) {
  Square square(scenes::glass(1.5f));
  square.material().attenuation_color = {0.5f, 1, 0.25f};
  square.material().attenuation_distance = 2;
  const SurfacePoint front = square.from({0, 0, -1}), back = square.from({0, 0, 1});
  EXPECT_FLOAT_EQ(front.bsdf.eta, 1.5f);
  EXPECT_FLOAT_EQ(back.bsdf.eta, 1 / 1.5f);
  EXPECT_NEAR(std::exp(-2 * front.attenuation.r), 0.5, 1e-6);
  EXPECT_EQ(front.attenuation.g, 0);
  EXPECT_NEAR(std::exp(-2 * front.attenuation.b), 0.25, 1e-6);
  EXPECT_TRUE(is_black(front.medium));
  EXPECT_EQ(back.medium, back.attenuation);
  square.material().transmission = 0;  // nothing gets inside
  EXPECT_TRUE(is_black(square.from({0, 0, -1}).attenuation));
}

TEST(SurfacePoint, EmitsToTheFrontOnlyUnlessDoubleSided) {
  Square square(scenes::emissive(Rgb(0.0f), {1, 2, 3}));
  EXPECT_EQ(square.from({0, 0, -1}).emission, (Rgb{1, 2, 3}));
  EXPECT_TRUE(is_black(square.from({0, 0, 1}).emission));
  square.material().double_sided = true;
  EXPECT_EQ(square.from({0, 0, 1}).emission, (Rgb{1, 2, 3}));
}

TEST(Opacity, FollowsTheAlphaMode) {
  Square square(scenes::diffuse(Rgb(1.0f)));
  square.material().base_alpha = 0.8f;
  square.material().base_color_texture.texture = square.add_texel(255, 255, 255, 127);
  EXPECT_EQ(opacity(square.scene, square.hit), 1);
  square.material().alpha = Alpha::blend;
  EXPECT_FLOAT_EQ(opacity(square.scene, square.hit), 0.8f * 127 / 255);
  square.material().alpha = Alpha::mask;
  EXPECT_EQ(opacity(square.scene, square.hit), 0);
  square.material().alpha_cutoff = 0.3f;
  EXPECT_EQ(opacity(square.scene, square.hit), 1);
  square.mesh().colors.assign(4, {Rgb(1.0f), 0.5f});
  EXPECT_EQ(opacity(square.scene, square.hit), 0);
}

TEST(OffsetOrigin, IsOnTheSideOfTheDirectionAndScales) {
  Square square(scenes::diffuse(Rgb(1.0f)));
  const SurfacePoint point = square.from({0, 0, -1});
  const Vec3 up = offset_origin(point, {0, 0.6f, 0.8f}), down = offset_origin(point, {0, 0.6f, -0.8f});
  EXPECT_GT(up.z, 0);
  EXPECT_LT(up.z, 4e-6f);
  EXPECT_EQ(down.z, -up.z);
  for (Vec3& p : square.mesh().positions) p *= 1024;
  EXPECT_EQ(offset_origin(square.from({0, 0, -1}), {0, 0.6f, 0.8f}), up * 1024);
  // Far from the world's origin, the offset is still more than rounding.
  for (Vec3& p : square.mesh().positions) p.z = 1e6f;
  EXPECT_GT(offset_origin(square.from({0, 0, -1}), {0, 0, 1}).z, 1e6f);
}

TEST(OffsetOrigin, IsSmallBesideTheOriginOnALargeFloor) {
  // No coordinate along its normal is rounded, however far it reaches.
  Square square(scenes::diffuse(Rgb(1.0f)));
  square.mesh().positions = {{-1e4f, -1e4f, 0}, {1e4f, -1e4f, 0}, {1e4f, 1e4f, 0}, {-1e4f, 1e4f, 0}};
  square.hit.u = 0, square.hit.v = 0.5f;
  EXPECT_LT(offset_origin(square.from({0, 0, -1}), {0, 0, 1}).z, 1e-3f);
}

}  // namespace
}  // namespace isophote
