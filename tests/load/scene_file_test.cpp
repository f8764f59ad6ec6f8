#include "isophote/load/scene_file.h"

#include <cmath>

#include "isophote/image/exr.h"
#include "isophote/load/scene_toml.h"
#include "load/gltf_builder.h"

namespace isophote::testing {
namespace {

const Warn ignore = [](const std::string&) {};

std::string toml_error(const std::string& text) {
  try {
    parse_scene_toml(text, "a.toml");
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

std::string load_error(const std::string& path) {
  try {
    load_scene(path, ignore);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneToml, SettingsKeepTextAndPlace) {
  const SceneToml toml = parse_scene_toml(R"([scene]
file = "room.glb"
[film]
size = [512, 256]
exposure = -1.5
[method]
name = "cached"
secondary = true
error = 0.02
crop = []
clamp = false
)",
                                          "a.toml");
  EXPECT_EQ(toml.scene.path, "room.glb");
  EXPECT_EQ(toml.scene.place, "a.toml:2");
  EXPECT_FALSE(toml.environment);
  std::vector<std::string> seen;
  for (const Setting& s : toml.settings) seen.push_back(s.table + "." + s.key + "=" + s.value + "@" + s.place);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, (std::vector<std::string>{"film.exposure=-1.5@a.toml:5", "film.size=512,256@a.toml:4",
                                            "method.clamp=off@a.toml:11", "method.crop=@a.toml:10",
                                            "method.error=0.02@a.toml:9", "method.name=cached@a.toml:7",
                                            "method.secondary=on@a.toml:8"}));
}

TEST(SceneToml, EnvironmentDefaults) {
  const SceneToml toml =
      parse_scene_toml("scene = {file = 'a.glb'}\n[environment]\nfile = 'sky.exr'\nrotation = 90\n", "a.toml");
  ASSERT_TRUE(toml.environment);
  EXPECT_EQ(toml.environment->file.path, "sky.exr");
  EXPECT_EQ(toml.environment->rotation, 90);
  EXPECT_EQ(toml.environment->intensity, 1);
}

TEST(SceneToml, ErrorsNameTheirLine) {
  const std::string scene = "[scene]\nfile = 'a.glb'\n";
  EXPECT_EQ(toml_error(""), "a.toml:1: needs a table [scene] with the key 'file', which names a glTF file");
  EXPECT_EQ(toml_error("[scene]\n"), "a.toml:1: [scene] needs a key 'file'");
  EXPECT_EQ(toml_error("[scene]\nfile = 3\n"), "a.toml:2: [scene] file must be a path");
  EXPECT_EQ(toml_error("[scene]\nfile = ''\n"), "a.toml:2: [scene] file must be a path");
  EXPECT_EQ(toml_error("scene = 'a.glb'\n"), "a.toml:1: 'scene' must be a table");
  EXPECT_EQ(toml_error("[scene]\nfiel = 'a.glb'\n"), "a.toml:2: unknown key 'fiel' in [scene]: there are file");
  EXPECT_EQ(toml_error(scene + "[camera]\nfov = 3\n"),
            "a.toml:3: unknown table or key 'camera': there are scene, environment, media, film, method");
  EXPECT_EQ(toml_error(scene + "[environment]\nfile = 'a'\nturn = 3\n"),
            "a.toml:5: unknown key 'turn' in [environment]: there are file, rotation, intensity");
  EXPECT_EQ(toml_error(scene + "[environment]\n"), "a.toml:3: [environment] needs a key 'file'");
  EXPECT_EQ(toml_error(scene + "[environment]\nfile = 'a'\nintensity = -1\n"),
            "a.toml:5: intensity must not be negative");
  EXPECT_EQ(toml_error(scene + "[environment]\nfile = 'a'\nintensity = nan\n"), "a.toml:5: intensity must be a number");
  EXPECT_EQ(toml_error(scene + "[environment]\nfile = 'a'\nrotation = '9'\n"), "a.toml:5: rotation must be a number");
  EXPECT_EQ(toml_error(scene + "[film]\nsize = {w = 3}\n"),
            "a.toml:4: size must be text, a number, true, false, or an array of these");
  EXPECT_EQ(toml_error(scene + "[film]\nsize = [[3]]\n"),
            "a.toml:4: size must be text, a number, true, false, or an array of these");
  EXPECT_EQ(toml_error(scene + "[film]\nday = 2020-01-01\n"),
            "a.toml:4: day must be text, a number, true, false, or an array of these");
  EXPECT_EQ(toml_error("[scene]\nfile = 'a\n").substr(0, 9), "a.toml:2:");
  EXPECT_EQ(toml_error("[scene]\nfile = 'a'\nfile = 'b'\n").substr(0, 9), "a.toml:3:");
}

TEST(SceneFile, GltfIsASceneByItself) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.triangle();
  for (const std::string& path : {folder.write("a.GLB", builder.glb()), folder.write("a.gltf", builder.gltf())}) {
    const LoadedScene loaded = load_scene(path, ignore);
    EXPECT_EQ(loaded.scene.triangle_count(), 1u);
    EXPECT_TRUE(loaded.settings.empty());
  }
}

ExrFile sky(const Rgb& special) {
  RgbImage image(4, 2, Rgb(1, 2, 3));
  image.at(2, 1) = special;
  ExrFile file;
  file.width = 4, file.height = 2;
  file.add_rgb("", image);
  return file;
}

TEST(SceneFile, EnvironmentIsScaledAndTurned) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.triangle();
  folder.write("models/a.glb", builder.glb());
  write_exr((folder.path() / "sky.exr").string(), sky(Rgb(4, 5, 6)));
  const std::string path = folder.write("a.toml",
                                        "[scene]\nfile = 'models/a.glb'\n[environment]\nfile = 'sky.exr'\nrotation = "
                                        "405\nintensity = 0.5\n[film]\nspp = 4\n");
  const LoadedScene loaded = load_scene(path, ignore);
  const EnvironmentMap& map = loaded.scene.environment;
  EXPECT_EQ(map.radiance.width, 4);
  EXPECT_EQ(map.radiance.at(0, 0), Rgb(0.5f, 1, 1.5f));
  EXPECT_EQ(map.radiance.at(2, 1), Rgb(2, 2.5f, 3));
  EXPECT_NEAR(map.rotation, pi / 4, 1e-6);
  ASSERT_EQ(loaded.settings.size(), 1u);
  EXPECT_EQ(loaded.settings[0].place, path + ":8");
}

TEST(SceneFile, BadEnvironments) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.triangle();
  folder.write("a.glb", builder.glb());
  const std::string exr = (folder.path() / "sky.exr").string();
  const std::string start = "[scene]\nfile = 'a.glb'\n[environment]\nfile = 'sky.exr'\n";
  const std::string path = folder.write("a.toml", start), bright = folder.write("b.toml", start + "intensity = 1e39\n");
  EXPECT_EQ(load_error(path), path + ":4: no file '" + exr + "'");
  for (const Rgb& bad : {Rgb(std::nanf(""), 0, 0), Rgb(0, -1, 0), Rgb(0, 0, infinity)}) {
    write_exr(exr, sky(bad));
    EXPECT_EQ(load_error(path), exr + ": pixel (2, 1) is negative or not a number");
  }
  write_exr(exr, sky(Rgb(1.0f)));
  EXPECT_EQ(load_error(path), "");
  EXPECT_EQ(load_error(bright), bright + ":4: pixel (0, 0) times the intensity is above 1e+30");
  write_exr(exr, sky(Rgb(0, 2e30f, 0)));
  EXPECT_EQ(load_error(path), path + ":4: pixel (2, 1) times the intensity is above 1e+30");
  EXPECT_EQ(load_error(folder.write("c.toml", start + "intensity = 0.5\n")), "");
  folder.write("sky.exr", std::string("no picture"));
  EXPECT_EQ(load_error(path).substr(0, exr.size() + 2), exr + ": ");
}

TEST(SceneFile, WrongFiles) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_error("scene.obj"), "scene.obj: is not a scene: a .glb, .gltf or .toml file is needed");
  const std::string missing = (folder.path() / "missing.toml").string();
  EXPECT_EQ(load_error(missing), missing + ": no such file");
  const std::string lost = folder.write("lost.toml", std::string("[scene]\nfile = 'b.glb'\n"));
  EXPECT_EQ(load_error(lost), lost + ":2: no file '" + (folder.path() / "b.glb").string() + "'");
  const std::string other = folder.write("other.toml", std::string("[scene]\nfile = 'b.obj'\n"));
  EXPECT_EQ(load_error(other), other + ":2: [scene] file must be a .glb or .gltf file");
  const std::string large = folder.write("large.toml", std::string(2 << 20, '\n'));
  EXPECT_EQ(load_error(large), large + ": is over 1 MiB, too large for a scene file");
}

}  // namespace
}  // namespace isophote::testing
