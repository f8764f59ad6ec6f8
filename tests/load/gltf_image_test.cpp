#include <sys/resource.h>
#include <tiny_gltf.h>

#include "load/material_builder.h"

namespace isophote::testing {
namespace {

TEST(GltfImage, EmbeddedInABufferView) {
  MaterialBuilder builder;
  builder.material()["emissiveTexture"] = {{"index", 0}};
  const std::size_t view = builder.view(two_pixels());
  builder.document["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  const Loaded loaded = try_load(builder.glb());
  EXPECT_EQ(loaded.error, "");
  EXPECT_EQ(loaded.scene.textures.at(0).rgba, (Bytes{0, 64, 128, 255, 255, 32, 16, 0}));
}

TEST(GltfImage, ExternalFilesByPercentEncodedNames) {
  const TemporaryFolder folder;
  folder.write("maps/a b%.png", two_pixels());
  MaterialBuilder builder;
  builder.material()["emissiveTexture"] = {{"index", 0}};
  for (const char* uri : {"maps/a%20b%.png", "./maps/../maps/a b%25.png"}) {
    builder.document["images"] = {{{"uri", uri}}};
    const Loaded loaded = try_load(builder, folder.path());
    EXPECT_EQ(loaded.error, "");
    EXPECT_EQ(loaded.scene.textures.size(), 1u);
  }
}

TEST(GltfImage, SixteenBitsAndThreeChannels) {
  MaterialBuilder builder;
  builder.material()["emissiveTexture"] = {{"index", 0}};
  // 0x8080 is 128.0 of 255, 0x00ff is 0.99, 0x7f80 is 127.0.
  builder.document["images"] = {{{"uri", png_uri(png(1, 1, {0x80, 0x80, 0x00, 0xff, 0x7f, 0x7f}, 3, 16))}}};
  EXPECT_EQ(load(builder).textures.at(0).rgba, (Bytes{128, 1, 127, 255}));
}

/// The most memory that this process has held, in MiB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// One pixel, behind which the file packs 256 MiB.
TEST(GltfImage, NoMoreIsInflatedThanThePictureHolds) {
  MaterialBuilder builder;
  builder.material()["emissiveTexture"] = {{"index", 0}};
  builder.document["images"] = {{{"uri", png_uri(png_of(1, 1, packed_zeros(256 << 20)))}}};
  const double before = peak_memory();
  EXPECT_EQ(load(builder).textures.at(0).rgba, (Bytes{0, 0, 0, 0}));
  EXPECT_LT(peak_memory() - before, 64);
}

// The rows that decoding keeps are there once, however many pictures there are.
TEST(GltfImage, DecodingGivesItsMemoryBack) {
  constexpr unsigned width = 8192, step = 4096;
  MaterialBuilder builder;
  const std::size_t view = builder.view(png(width, 1, Bytes(width * 6), 3, 16));
  builder.document["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  const auto least_memory = [&] {
    const Bytes bytes = builder.glb();
    for (std::uint64_t memory = step;; memory += step)
      if (memory > plenty || try_load(bytes, "nowhere", memory).error.empty()) return memory;
  };
  builder.material()["emissiveTexture"] = {{"index", 0}};
  const std::uint64_t one = least_memory();
  builder.material()["normalTexture"] = {{"index", 1}};
  EXPECT_LT(least_memory(), one + 4 * width + 2 * step);
}

TEST(GltfImage, Jpeg) {
  tinygltf::Image grey;
  grey.width = grey.height = 8, grey.component = 3, grey.bits = 8, grey.pixel_type = ubyte_type;
  grey.image.assign(8 * 8 * 3, 200);
  std::string uri;
  const std::string folder, name = "grey.jpg";
  ASSERT_TRUE(tinygltf::WriteImageData(&folder, &name, &grey, true, &uri, nullptr));
  MaterialBuilder builder;
  builder.material()["emissiveTexture"] = {{"index", 0}};
  builder.document["images"] = {{{"uri", uri}}};
  const Texture texture = load(builder).textures.at(0);
  EXPECT_EQ(texture.width, 8);
  ASSERT_EQ(texture.rgba.size(), 8u * 8 * 4);
  EXPECT_NEAR(texture.rgba[0], 200, 2);
  EXPECT_EQ(texture.rgba[3], 255);
}

TEST(GltfImage, UnusedImagesAreNotOpened) {
  MaterialBuilder builder;
  builder.document["images"].push_back({{"uri", "missing.png"}});
  EXPECT_EQ(load(builder).textures.size(), 0u);
}

}  // namespace
}  // namespace isophote::testing
