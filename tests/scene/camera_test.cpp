#include "isophote/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isophote {
namespace {

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-6f) << a.x << " " << a.y << " " << a.z; }

TEST(Camera, MiddleAndEdges) {
  const float fov = 1.0f;
  const Camera camera = Camera::look_at({1, 2, 3}, {1, 2, -5}, fov);
  const float t = std::tan(0.5f);
  expect_near(camera.ray(100, 50, 200, 100).direction, {0, 0, -1});
  expect_near(camera.ray(100, 50, 200, 100).origin, {1, 2, 3});
  expect_near(camera.ray(100, 0, 200, 100).direction, normalize(Vec3{0, t, -1}));
  expect_near(camera.ray(100, 100, 200, 100).direction, normalize(Vec3{0, -t, -1}));
  expect_near(camera.ray(200, 50, 200, 100).direction, normalize(Vec3{2 * t, 0, -1}));
  expect_near(camera.ray(0, 50, 200, 100).direction, normalize(Vec3{-2 * t, 0, -1}));
}

TEST(Camera, FrameIsOrthonormalEvenLookingDown) {
  for (const Vec3& target : {Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{3, 1, -2}, Vec3{-1, 0, 0}}) {
    const Camera c = Camera::look_at({0, 0, 0}, target, 1);
    EXPECT_NEAR(dot(c.right, c.up), 0, 1e-6);
    EXPECT_NEAR(dot(c.right, c.forward), 0, 1e-6);
    EXPECT_NEAR(dot(c.up, c.forward), 0, 1e-6);
    EXPECT_NEAR(length(c.right), 1, 1e-6);
    EXPECT_NEAR(length(c.up), 1, 1e-6);
    expect_near(cross(c.right, c.up), -c.forward);
    expect_near(c.forward, normalize(target));
    EXPECT_GE(c.up.y, -1e-6f);
  }
}

TEST(Camera, PixelAngleIsThatBetweenPixelEdges) {
  const Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, 0.9f);
  const Vec3 a = camera.ray(50, 49.5f, 100, 100).direction, b = camera.ray(50, 50.5f, 100, 100).direction;
  EXPECT_NEAR(camera.pixel_angle(100), std::asin(length(cross(a, b))), 1e-6);
}

}  // namespace
}  // namespace isophote
