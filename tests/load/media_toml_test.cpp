#include <gtest/gtest.h>

#include "isophote/core/error.h"
#include "isophote/load/scene_toml.h"

namespace isophote {
namespace {

const std::string scene = "[scene]\nfile = 'a.glb'\n";

std::vector<SceneToml::Medium> media(const std::string& text) { return parse_scene_toml(scene + text, "a.toml").media; }

/// Of a [[media]] table whose keys begin in line 4.
std::string refusal(const std::string& keys, const std::string& before = "") {
  try {
    media(before + "[[media]]\n" + keys);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(MediaToml, CoefficientsAndDefaults) {
  const auto all = media("[[media]]\nsigma_s = [1, 2.5, 3]\nsigma_a = 0.5\n[[media]]\nname = 'haze'\nsigma_a = 1\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].scattering, Rgb(1, 2.5f, 3));
  EXPECT_EQ(all[0].absorption, Rgb(0.5f));
  EXPECT_EQ(all[0].emission, Rgb());
  EXPECT_EQ(all[0].g, 0);
  EXPECT_EQ(all[0].place, "a.toml:3");
  EXPECT_FALSE(all[0].height || all[0].grid || all[0].box || all[0].boundary);
  EXPECT_EQ(all[1].name, "haze");
  EXPECT_EQ(all[1].scattering, Rgb());
  EXPECT_EQ(all[1].absorption, Rgb(1.0f));
}

TEST(MediaToml, DensityAndAlbedo) {
  const auto all = media("[[media]]\ndensity = 4\n[[media]]\ndensity = 2\nalbedo = [0.5, 1, 0]\ng = -0.5\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].scattering, Rgb(4.0f));
  EXPECT_EQ(all[0].absorption, Rgb());
  EXPECT_EQ(all[1].scattering, Rgb(1, 2, 0));
  EXPECT_EQ(all[1].absorption, Rgb(1, 0, 2));
  EXPECT_EQ(all[1].g, -0.5f);
}

TEST(MediaToml, BoundsHeightAndGrid) {
  const auto all = media(
      "[[media]]\ndensity = 1\nbox = [[1, 5, 3], [2, 4, 6]]\nheight = {base = 0.5, scale = 1.5}\n"
      "[[media]]\nemission = [1, 2, 3]\nmesh = 'jar'\ngrid = {file = 'a.vdb', name = 'smoke', scale = 2}\n"
      "[[media]]\ndensity = 1\ngrid = {file = 'a.vdb'}\n");
  ASSERT_EQ(all.size(), 3u);
  ASSERT_TRUE(all[0].box && all[0].height);
  EXPECT_EQ(all[0].box->lower, Vec3(1, 4, 3));
  EXPECT_EQ(all[0].box->upper, Vec3(2, 5, 6));
  EXPECT_EQ(all[0].height->base, 0.5f);
  EXPECT_EQ(all[0].height->height, 1.5f);
  ASSERT_TRUE(all[1].boundary && all[1].grid);
  EXPECT_EQ(all[1].emission, Rgb(1, 2, 3));
  EXPECT_EQ(all[1].boundary->mesh, "jar");
  EXPECT_EQ(all[1].boundary->place, "a.toml:9");
  EXPECT_EQ(all[1].grid->file.path, "a.vdb");
  EXPECT_EQ(all[1].grid->file.place, "a.toml:10");
  EXPECT_EQ(all[1].grid->name, "smoke");
  EXPECT_EQ(all[1].grid->scale, 2);
  EXPECT_EQ(all[2].grid->name, "density");
  EXPECT_EQ(all[2].grid->scale, 1);
}

TEST(MediaToml, WhatExcludesEachOther) {
  for (const auto& [keys, a, b, line] :
       {std::tuple{"density = 1\nsigma_s = 1\n", "density", "sigma_s", 5},
        {"sigma_a = 1\ng = 0\ndensity = 1\n", "density", "sigma_a", 6},
        {"sigma_s = 1\nalbedo = 1\n", "albedo", "sigma_s", 5},
        {"density = 1\nmesh = 'a'\nbox = [[0, 0, 0], [1, 1, 1]]\n", "box", "mesh", 6},
        {"density = 1\nheight = {scale = 1}\ngrid = {file = 'a'}\n", "height", "grid", 6}})
    EXPECT_EQ(refusal(keys),
              "a.toml:" + std::to_string(line) + ": [[media]] " + a + " and " + b + " exclude each other");
}

TEST(MediaToml, NumbersAreChecked) {
  const auto expect = [](const std::string& keys, const std::string& message) {
    EXPECT_EQ(refusal(keys), "a.toml:" + message) << keys;
  };
  expect("", "3: [[media]] needs sigma_s, sigma_a, density or emission above 0");
  expect("sigma_s = 0\nsigma_a = [0, 0, 0]\n", "3: [[media]] needs sigma_s, sigma_a, density or emission above 0");
  expect("sigma_s = 1e-60\n", "3: [[media]] needs sigma_s, sigma_a, density or emission above 0");
  expect("sigma_s = -1\n", "4: sigma_s must be from 0 to 5e+08");
  expect("sigma_s = [1, 2, -3]\n", "4: sigma_s must be from 0 to 5e+08");
  expect("sigma_s = nan\n", "4: sigma_s must be a number");
  expect("sigma_a = [1, 2, inf]\n", "4: sigma_a must be a number");
  expect("sigma_a = 1e9\n", "4: sigma_a must be from 0 to 5e+08");
  expect("sigma_a = [1, 2]\n", "4: sigma_a must be a number or [red, green, blue]");
  expect("sigma_a = 'red'\n", "4: sigma_a must be a number or [red, green, blue]");
  expect("sigma_a = [1, 2, '3']\n", "4: sigma_a must be a number");
  expect("density = 0\n", "4: density must be above 0, and at most 1e+09");
  expect("density = 1\nalbedo = 1.1\n", "5: albedo must be from 0 to 1");
  expect("emission = 1\nalbedo = 1\n", "5: [[media]] albedo needs a key 'density'");
  expect("emission = -1\n", "4: emission must be from 0 to 1e+30");
  for (const char* g : {"1", "-1", "1.5", "0.99999999999"})
    expect(std::string("density = 1\ng = ") + g + "\n", "5: g must be between -1 and 1");
  expect("density = 1\ng = 'a'\n", "5: g must be a number");
  expect("density = 1\nname = 3\n", "5: [[media]] name must be text");
  expect("density = 1\nmesh = ''\n", "5: [[media]] mesh must be text");
  expect("density = 1\nmesh = 1\n", "5: [[media]] mesh must be text");
}

TEST(MediaToml, BoundsHeightsAndGridsAreChecked) {
  const auto expect = [](const std::string& keys, const std::string& message) {
    EXPECT_EQ(refusal("density = 1\n" + keys + "\n"), "a.toml:5: " + message) << keys;
  };
  const std::string form = "box must be two opposite corners, [[x, y, z], [x, y, z]]";
  for (const char* box : {"1", "[]", "[[0, 0, 0]]", "[[0, 0, 0], [1, 1]]", "[0, 0, 0, 1, 1, 1]", "[1, 2]"})
    expect(std::string("box = ") + box, form);
  expect("box = [[0, 0, 0], [1, 1, 0]]", "box has no volume");
  expect("box = [[0, 0, 0], [1, 1, nan]]", "box must be a number");
  expect("box = [[0, 0, 0], [1, 1, 1e10]]", "box must lie within 1e+09 of the origin");
  expect("height = 3", "'height' must be a table");
  expect("height = {base = 3}", "[[media]] height needs a key 'scale'");
  expect("height = {scale = 0}", "scale must be above 0, and at most 1e+09");
  expect("height = {scale = 1, base = 1e10}", "base must be within 1e+09 of 0");
  expect("height = {scale = 1, top = 1}", "unknown key 'top' in [[media]] height: there are base, scale");
  expect("grid = 'a.vdb'", "'grid' must be a table");
  expect("grid = {name = 'a'}", "[[media]] grid needs a key 'file'");
  expect("grid = {file = ''}", "[[media]] grid file must be a path");
  expect("grid = {file = 'a', name = 1}", "[[media]] grid name must be text");
  expect("grid = {file = 'a', scale = -1}", "scale must be above 0, and at most 1e+30");
  expect("grid = {file = 'a', size = 1}", "unknown key 'size' in [[media]] grid: there are file, name, scale");
}

TEST(MediaToml, TheArrayIsChecked) {
  const auto error = [](const std::string& text) {
    try {
      media(text);
    } catch (const UserError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error("[media]\ndensity = 1\n"), "a.toml:3: 'media' must be an array of tables, [[media]]");
  EXPECT_EQ(
      error("[film]\nspp = 1\n[[media]]\ndensty = 1\n"),
      "a.toml:6: unknown key 'densty' in [[media]]: there are name, sigma_s, sigma_a, density, albedo, g, emission, "
      "box, mesh, height, grid");
  std::string many;
  for (int i = 0; i < 32; ++i) many += "[[media]]\ndensity = 1\n";
  EXPECT_EQ(error(many), "");
  EXPECT_EQ(error(many + "[[media]]\ndensity = 1\n"), "a.toml:67: over 32 media");
}

}  // namespace
}  // namespace isophote
