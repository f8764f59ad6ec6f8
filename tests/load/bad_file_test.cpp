#include "load/sound_document.h"

namespace isophote::testing {
namespace {

TEST(BadGltfFile, TheSoundDocumentLoads) {
  const Scene scene = load(sound());
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(scene.lights.size(), 1u);
}

TEST(BadGltfFile, EveryTruncationOfAGlbIsRefused) {
  const Bytes whole = sound().glb();
  ASSERT_EQ(try_load(whole).error, "");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(try_load(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))).error, "") << size;
}

TEST(BadGltfFile, BrokenGlbHeaders) {
  const auto with_byte = [](std::size_t at, unsigned char value) {
    Bytes bytes = sound().glb();
    bytes[at] = value;
    return try_load(bytes).error;
  };
  EXPECT_EQ(with_byte(4, 1), "test.gltf: GLB version 1 is not supported, only 2");
  EXPECT_EQ(with_byte(11, 0x7f).substr(0, 32), "test.gltf: truncated: its header");
  EXPECT_EQ(with_byte(15, 0x7f), "test.gltf: GLB chunk 0 reaches beyond the end of the file");
  EXPECT_EQ(with_byte(16, 'B'), "test.gltf: the first GLB chunk is not JSON");
}

TEST(BadGltfFile, BrokenJson) {
  EXPECT_EQ(try_load(to_bytes("{\"asset\": ")).error.substr(0, 41), "test.gltf: not valid JSON: parse error at");
  EXPECT_EQ(try_load(to_bytes("[1, 2]")).error, "test.gltf: not valid glTF: the JSON is not an object");
  EXPECT_NE(try_load(to_bytes("{\"asset\": {\"version\": 1e999}}")).error, "");
  EXPECT_NE(try_load(Bytes{}).error, "");
  EXPECT_NE(try_load(to_bytes(std::string("{\"asset\": \"\xff\xfe\"}"))).error, "");
}

TEST(BadGltfFile, EveryByteOfTheJsonMayBreak) {
  const std::string text = sound().gltf();
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char c : {'0', '"', '}', '-'}) {
      std::string broken = text;
      broken[i] = c;
      const std::string error = try_load(to_bytes(broken)).error;  // may still load: the point is that it returns
      EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

TEST(BadGltfFile, WhatDoesNotFitInMemoryIsRefusedFirst) {
  // 4 billion vertices out of nothing: an accessor without a buffer view is all zeros.
  GltfBuilder builder;
  builder.triangle();
  builder.document["accessors"][0] = {{"componentType", float_type}, {"type", "VEC3"}, {"count", 4000000000u}};
  EXPECT_EQ(try_load(builder).error.substr(0, 75),
            "test.gltf: meshes[0] \"mesh\": primitives[0]: mesh data: does not fit in memo");

  GltfBuilder instances;
  instances.triangle();
  for (int i = 0; i < 200; ++i) instances.node({{"mesh", 0}});
  const Bytes bytes = to_bytes(instances.gltf());
  EXPECT_EQ(try_load(bytes, "nowhere", 1 << 20).error, "");
  EXPECT_NE(try_load(bytes, "nowhere", 200000).error.find("does not fit in memory"), std::string::npos);
}

TEST(BadGltfFile, FilesThatAreNone) {
  const TemporaryFolder folder;
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      load_gltf(path, [](const std::string&) {});
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  const std::string missing = (folder.path() / "missing.glb").string();
  EXPECT_EQ(error_of(missing), missing + ": no such file");
  EXPECT_EQ(error_of(folder.path().string()), folder.path().string() + ": is a directory");
  EXPECT_EQ(error_of("/dev/zero"), "/dev/zero: is not a regular file");
}

}  // namespace
}  // namespace isophote::testing
