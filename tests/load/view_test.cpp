#include <cmath>

#include "load/gltf_builder.h"

namespace isophote::testing {
namespace {

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LE(length(a - b), 1e-6f) << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

json perspective(double yfov, json name = "") {
  return {{"type", "perspective"}, {"name", name}, {"perspective", {{"yfov", yfov}, {"znear", 0.1}}}};
}

TEST(GltfCamera, StandsWhereItsNodeIs) {
  GltfBuilder builder;
  builder.triangle();
  builder.document["cameras"] = {perspective(0.5, "main"), perspective(0.7)};
  builder.document["cameras"][0]["perspective"]["aspectRatio"] = 1.5;
  const double h = std::sqrt(0.5);
  builder.node({{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"scale", {2, 2, 2}}});
  builder.node({{"camera", 1}, {"name", "side"}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), 2u);
  const Camera& main = scene.cameras[0];
  EXPECT_EQ(main.name, "main");
  EXPECT_EQ(main.fov_y, 0.5f);
  EXPECT_EQ(main.aspect, 1.5f);
  expect_near(main.eye, {1, 2, 3});
  expect_near(main.forward, {-1, 0, 0});  // +90 degrees about Y takes -Z to -X
  expect_near(main.right, {0, 0, -1});
  expect_near(main.up, {0, 1, 0});
  EXPECT_EQ(scene.cameras[1].name, "side");
  EXPECT_EQ(scene.cameras[1].aspect, 0.0f);
}

TEST(GltfCamera, WithoutOneEverythingIsInView) {
  GltfBuilder builder;
  const std::size_t positions = builder.vec3({-1, 2, 3, 7, 2, 3, -1, 12, 3, -1, 2, 1});
  const std::size_t indices = builder.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 1, 3}, "SCALAR", ubyte_type, 1);
  builder.node({{"mesh", builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  const Box bounds = scene.bounds();
  EXPECT_GT(camera.eye.z, bounds.upper.z);     // from the front
  EXPECT_GT(camera.eye.y, bounds.center().y);  // from above
  EXPECT_NEAR(camera.fov_y, 40 * pi / 180, 1e-6);
  const float half = std::tan(camera.fov_y / 2);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? bounds.upper.x : bounds.lower.x, corner & 2 ? bounds.upper.y : bounds.lower.y,
                 corner & 4 ? bounds.upper.z : bounds.lower.z};
    const float depth = dot(p - camera.eye, camera.forward);
    EXPECT_LT(std::abs(dot(p - camera.eye, camera.right)), half * depth);
    EXPECT_LT(std::abs(dot(p - camera.eye, camera.up)), half * depth);
  }
}

TEST(GltfCamera, OneThatNoNodeHoldsIsNotInTheScene) {
  GltfBuilder builder;
  builder.triangle();
  builder.document["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}}}}};
  EXPECT_EQ(load(builder).cameras.at(0).name, "default");
}

TEST(GltfLight, EveryKind) {
  GltfBuilder builder;
  builder.triangle();
  builder.document["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type": "point", "color": [1, 0.5, 0.25], "intensity": 40, "range": 12, "name": "bulb"},
    {"type": "spot", "intensity": 10, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
    {"type": "directional", "intensity": 3}, {"type": "spot", "spot": {}},
    {"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}}])");
  for (int light = 0; light < 5; ++light)
    builder.node({{"name", "holder"},
                  {"translation", {0, 5, 0}},
                  {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                  {"scale", {3, 3, 3}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  const auto lights = load(builder).lights;
  ASSERT_EQ(lights.size(), 5u);
  EXPECT_EQ(lights[0].kind, PunctualLight::Kind::point);
  EXPECT_EQ(lights[0].name, "bulb");
  EXPECT_EQ(lights[0].intensity, Rgb(40, 20, 10));
  EXPECT_EQ(lights[0].range, 12);
  EXPECT_EQ(lights[0].position, (Vec3{0, 5, 0}));
  EXPECT_EQ(lights[1].kind, PunctualLight::Kind::spot);
  EXPECT_EQ(lights[1].name, "holder");
  EXPECT_EQ(lights[1].intensity, Rgb(10.0f));
  EXPECT_EQ(lights[1].inner_cone, 0.25f);
  EXPECT_EQ(lights[1].outer_cone, 0.5f);
  EXPECT_EQ(lights[1].range, infinity);
  expect_near(lights[1].direction, {0, -1, 0});  // -90 degrees about X takes -Z to -Y
  EXPECT_EQ(lights[2].kind, PunctualLight::Kind::directional);
  EXPECT_EQ(lights[2].intensity, Rgb(3.0f));
  EXPECT_EQ(lights[3].inner_cone, 0);
  EXPECT_NEAR(lights[3].outer_cone, pi / 4, 1e-7);
  EXPECT_EQ(lights[4].inner_cone, 0.5f);  // an edge without falloff
  EXPECT_EQ(lights[4].outer_cone, 0.5f);
}

}  // namespace
}  // namespace isophote::testing
