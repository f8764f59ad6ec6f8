#include "isophote/scene/emissive_triangles.h"

#include <gtest/gtest.h>

#include "isophote/scene/emitter.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Estimate;
using statistics::Random;

Texture black_texture(int width, int height) {
  Texture texture;
  texture.width = width, texture.height = height;
  texture.rgba.assign(static_cast<std::size_t>(width) * height * 4, 0);
  return texture;
}
void light(Texture& texture, int x, int y) {
  for (int c = 0; c < 4; ++c) texture.rgba[(static_cast<std::size_t>(y) * texture.width + x) * 4 + c] = 255;
}

/// A square lamp of radiance 1 times the texture, at height 1, shining down, two by two metres.
Scene textured_lamp(Texture texture) {
  Scene scene;
  Material material = scenes::emissive(Rgb(0.0f), Rgb(1.0f));
  material.emission_texture.texture = 0;
  scene.textures.push_back(std::move(texture));
  scene.meshes.push_back(scenes::quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, scenes::add(scene, material)));
  return scene;
}

/// LEDs of 2 x 2 texels every `spacing` texels, where 256 points along an edge of the lamp miss all of them.
Texture leds(int spacing) {
  Texture texture = black_texture(2048, 2048);
  for (int y = 7; y < 2048; y += spacing)
    for (int x = 7; x < 2048; x += spacing)
      for (const int i : {0, 1})
        for (const int j : {0, 1}) light(texture, (x + i) % 2048, (y + j) % 2048);
  return texture;
}

TEST(EmissiveTriangles, LightBetweenTheSamplesIsSampled) {
  const Scene scene = textured_lamp(leds(8));
  const Emitters emitters(scene);
  for (const std::uint32_t t : {0u, 1u}) {
    EXPECT_GT(emitters.triangle_pdf({0, t, 0.3f, 0.3f}, {}, {0, 1, 0}), 0);
    EXPECT_GT(emitters.triangle_pdf({0, t, 0.3f, 0.3f}, {}, {0, 1, 0}, Emitters::Among::sampled_directly), 0);
  }
  // 4 of 64 texels: as far away as this, a lamp of radiance 1/16. Irradiance below its middle, by the form factor of a
  // rectangle seen from below its corner, four times.
  const double truth = 4 * 0.5 / std::sqrt(2) * 2 * std::atan(1 / std::sqrt(2)) / 16;
  Estimate estimate;
  Random random(3);
  for (int i = 0; i < 200000; ++i) {
    const float choice = random.next();
    const LightSample s = emitters.sample({}, choice, random.next2(), Emitters::Among::sampled_directly);
    estimate.add(s.pdf > 0 ? s.radiance.g * s.direction.y / s.pdf : 0);
  }
  statistics::expect_mean(estimate, truth, 0.015);
}

TEST(EmissiveTriangles, WhateverEmitsIsChosenWithAChance) {
  // Few LEDs, a bright lamp beside them, and the LEDs' texture turned and tiled by a transform.
  Scene scene = textured_lamp(leds(512));
  scene.materials[0].emission_texture.matrix = {2.1f, -0.7f, 0.3f, 0.7f, 1.9f, -5};
  scene.meshes.push_back(
      scenes::quad({3, 1, -1}, {2, 0, 0}, {0, 0, 2}, scenes::add(scene, scenes::emissive(Rgb(0.0f), Rgb(1e6f)))));
  const Emitters emitters(scene);
  Random random(4);
  int emitting = 0;
  for (int i = 0; i < 400000; ++i) {
    const float choice = random.next();
    const Vec2 b = random.next2();
    const Hit hit{0, choice < 0.5f ? 0u : 1u, b.x * (1 - b.y), b.y};
    if (is_black(emission(scene, hit))) continue;
    ++emitting;
    EXPECT_GT(emitters.triangle_pdf(hit, {}, {0, 1, 0}), 0);
  }
  EXPECT_GT(emitting, 10);
}

TEST(EmissiveTriangles, MaskedByVertexAlphaIsKept) {
  Scene scene;
  Material material = scenes::emissive(Rgb(0.0f), Rgb(1.0f));
  material.alpha = Alpha::mask;
  material.alpha_cutoff = 0.99f;  // a hundredth of an edge is left of each triangle
  Mesh lamp = scenes::quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, scenes::add(scene, material));
  lamp.colors = {{Rgb(1.0f), 1}, {Rgb(1.0f), 0}, {Rgb(1.0f), 0}, {Rgb(1.0f), 0}};
  scene.meshes.push_back(lamp);
  const EmissiveTriangles found = emissive_triangles(scene);
  ASSERT_EQ(found.triangles.size(), 2u);
  for (const double power : found.powers) EXPECT_GT(power, 0);
}

TEST(EmissiveTriangles, BlackPartsOfATextureAreLeftOut) {
  // A lamp in a corner of an atlas, the rest of which 2046 triangles use.
  Texture atlas = black_texture(256, 256);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) light(atlas, x, y);
  Scene scene = textured_lamp(atlas);
  scene.meshes.clear();
  for (int i = 0; i < 1024; ++i) {
    const float u = static_cast<float>(i % 32) / 32, v = static_cast<float>(i / 32) / 32;
    Mesh part = scenes::quad({u, 1, v}, {1 / 32.0f, 0, 0}, {0, 0, 1 / 32.0f}, 0);
    for (Vec2& uv : part.uv[0]) uv = Vec2{u, v} + uv * (1 / 32.0f);
    scene.meshes.push_back(part);
  }
  const EmissiveTriangles found = emissive_triangles(scene);
  double power = 0;
  for (const double p : found.powers) power += p;
  EXPECT_NEAR(power, pi / 256, 0.2 * pi / 256);
  EXPECT_GE(found.triangles.size(), 8u);    // 2 x 2 parts shine,
  EXPECT_LE(found.triangles.size(), 260u);  // those about them may, and those at the border that wraps
}

TEST(EmissiveTriangles, PowersAreMeansOverAreas) {
  Texture half = black_texture(64, 1);
  for (int x = 32; x < 64; ++x) light(half, x, 0);
  Scene scene = textured_lamp(half);
  scene.materials[0].double_sided = true;
  const EmissiveTriangles found = emissive_triangles(scene);
  ASSERT_EQ(found.powers.size(), 2u);
  // Of the triangles below and above the diagonal 3/4 and 1/4 are lit.
  EXPECT_NEAR(found.powers[0], 2 * pi * 2 * 0.75, 0.02 * 2 * pi);
  EXPECT_NEAR(found.powers[1], 2 * pi * 2 * 0.25, 0.02 * 2 * pi);
}

TEST(EmissiveTriangles, ManyTexturedOnesShareABudget) {
  Texture white = black_texture(512, 512);
  std::fill(white.rgba.begin(), white.rgba.end(), std::uint8_t{200});
  Scene scene = textured_lamp(white);
  scene.meshes.resize(2000, scene.meshes[0]);
  const EmissiveTriangles found = emissive_triangles(scene);
  EXPECT_EQ(found.triangles.size(), 4000u);
  EXPECT_NEAR(found.powers[17] / (pi * 2), 200 / 255.0, 1e-4);
}

}  // namespace
}  // namespace isophote
