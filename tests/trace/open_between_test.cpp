#include <gtest/gtest.h>

#include <cmath>

#include "isophote/trace/shadow.h"
#include "render.h"
#include "support/records.h"
#include "support/scenes.h"

namespace isophote {
namespace {

using test::RandomPlaces;

constexpr Vec3 up{0, 1, 0};

/// A floor with a wall across it at x = 0 that reaches from `bottom` to 1, of one quad without thickness.
Scene parted_floor(const Material& wall, float bottom = 0) {
  Scene scene;
  scene.meshes.push_back(
      scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, scenes::add(scene, scenes::diffuse(Rgb(0.5f)))));
  scene.meshes.push_back(scenes::quad({0, bottom, -5}, {0, 0, 10}, {0, 1 - bottom, 0}, scenes::add(scene, wall)));
  return scene;
}

bool open(Stage& stage, const Vec3& a, const Vec3& b) {
  return open_between(stage.world, {a, up}, {b, up}, stage.counts);
}

TEST(OpenBetween, AWallAcrossTheFloorStopsIt) {
  Stage stage(parted_floor(scenes::diffuse(Rgb(0.5f))));
  RandomPlaces random(3);
  for (int i = 0; i < 1000; ++i) {
    const float far = random.number(1e-3f, 3), near = random.number(1e-3f, 3), z = random.number(-1, 1);
    EXPECT_FALSE(open(stage, {-far, 0, 0}, {near, 0, z}));
    EXPECT_FALSE(open(stage, {near, 0, z}, {-far, 0, 0}));
    EXPECT_TRUE(open(stage, {far, 0, 0}, {near, 0, z}));
    EXPECT_TRUE(open(stage, {0, 0, 0}, {near, 0, z}));  // at its foot
  }
  EXPECT_EQ(stage.counts.verification, 4000u);
  EXPECT_EQ(stage.counts.total(), 4000u);
  EXPECT_TRUE(open(stage, {1, 0, 1}, {1, 0, 1}));
}

// A gap of a hundredth of the way under a door is none; what is high enough to walk under is open.
TEST(OpenBetween, ADoorIsClosedInSpiteOfTheGapUnderIt) {
  Stage door(parted_floor(scenes::diffuse(Rgb(0.5f)), 0.01f)), bridge(parted_floor(scenes::diffuse(Rgb(0.5f)), 0.5f));
  EXPECT_FALSE(open(door, {-0.5f, 0, 0}, {0.5f, 0, 0.3f}));
  EXPECT_TRUE(open(bridge, {-0.5f, 0, 0}, {0.5f, 0, 0.3f}));
}

TEST(OpenBetween, HolesAreOpenAndGlassIsNot) {
  Material hole = scenes::diffuse(Rgb(0.5f)), pane = scenes::glass(1.5f);
  hole.alpha = Alpha::mask;
  hole.base_alpha = 0;
  pane.solid = false;
  Stage with_hole(parted_floor(hole)), with_pane(parted_floor(pane));
  EXPECT_TRUE(open(with_hole, {-0.5f, 0, 0}, {0.5f, 0, 0}));
  EXPECT_FALSE(open(with_pane, {-0.5f, 0, 0}, {0.5f, 0, 0}));
}

/// A sphere of radius 1 of `rings` x 2 `rings` quads, each cut in two.
Scene ball(int rings) {
  Scene scene;
  Mesh mesh;
  mesh.material = scenes::add(scene, scenes::diffuse(Rgb(0.5f)));
  const auto columns = static_cast<std::uint32_t>(2 * rings);
  for (int j = 0; j <= rings; ++j)
    for (std::uint32_t k = 0; k < columns; ++k) {
      const double theta = M_PI * j / rings, phi = 2 * M_PI * k / columns;
      mesh.positions.push_back(
          Vec3(Vec3d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi))));
    }
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rings); ++j)
    for (std::uint32_t k = 0; k < columns; ++k) {
      const std::uint32_t a = j * columns + k, b = j * columns + (k + 1) % columns;
      mesh.triangles.push_back({a, b, b + columns});
      mesh.triangles.push_back({a, b + columns, a + columns});
    }
  mesh.normals = mesh.positions;
  scene.meshes.push_back(mesh);
  return scene;
}

// From place to place on a sphere, as it is cut into triangles, outside and inside, as far as records reach.
TEST(OpenBetween, CurvedSurfacesAreNoObstacleToThemselves) {
  for (const int rings : {16, 48}) {
    Stage stage(ball(rings));
    RandomPlaces random(9);
    for (const float side : {1.0f, -1.0f}) {
      int blocked = 0;
      constexpr int tries = 5000;
      for (int i = 0; i < tries; ++i) {
        const Vec3 to = random.direction(), beside = random.direction_near(to, 0.6f);
        const float from = side > 0 ? 2 : 0;
        const SurfacePoint a = stage.hit(to * from, to * -side), b = stage.hit(beside * from, beside * -side);
        blocked +=
            !open_between(stage.world, {a.position, a.shading_normal}, {b.position, b.shading_normal}, stage.counts);
      }
      EXPECT_LT(blocked, 0.002 * tries) << rings << " rings, side " << side;
    }
  }
}

}  // namespace
}  // namespace isophote
