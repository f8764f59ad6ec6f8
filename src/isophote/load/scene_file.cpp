#include "isophote/load/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "isophote/image/exr.h"
#include "isophote/load/largest_radiance.h"
#include "isophote/load/media.h"
#include "isophote/load/messages.h"
#include "isophote/load/read_file.h"
#include "isophote/load/scene_toml.h"

namespace isophote {
namespace {

namespace fs = std::filesystem;

std::string lower_suffix(const std::string& path) {
  std::string suffix = fs::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

bool is_gltf(const std::string& path) {
  const std::string suffix = lower_suffix(path);
  return suffix == ".glb" || suffix == ".gltf";
}

EnvironmentMap read_environment(const SceneToml::Environment& source, const fs::path& folder) {
  const std::string path = resolve(source.file, folder);
  EnvironmentMap map;
  map.radiance = read_exr_layer(path, "");
  map.rotation = static_cast<float>(std::remainder(source.rotation, 360.0) * (pi / 180.0));
  for (std::size_t i = 0; i < map.radiance.pixels.size(); ++i) {
    Rgb& pixel = map.radiance.pixels[i];
    const auto width = static_cast<std::size_t>(map.radiance.width);
    const bool valid = is_finite(pixel) && std::min({pixel.r, pixel.g, pixel.b}) >= 0;
    if (!valid)
      throw UserError(fmt::format("{}: pixel ({}, {}) is negative or not a number", path, i % width, i / width));
    pixel = Rgb(Rgbd(pixel) * source.intensity);
    if (!(max_component(pixel) <= largest_radiance))
      throw UserError(fmt::format("{}: pixel ({}, {}) times the intensity is above {:g}", source.file.place, i % width,
                                  i / width, largest_radiance));
  }
  return map;
}

}  // namespace

LoadedScene load_scene(const std::string& path, const Warn& warn) {
  LoadedScene loaded;
  if (is_gltf(path)) {
    loaded.scene = load_gltf(path, warn, &loaded.files);
    return loaded;
  }
  if (lower_suffix(path) != ".toml") throw UserError(path + ": is not a scene: a .glb, .gltf or .toml file is needed");

  constexpr std::uint64_t largest = 1 << 20;  // bytes; settings are a page
  std::error_code error;
  if (const auto size = fs::file_size(path, error); !error && size > largest)
    throw UserError(path + ": is over 1 MiB, too large for a scene file");
  MemoryBudget budget(physical_memory());
  const auto bytes = with_place(path, [&] { return read_file(path, budget); });
  const SceneToml toml = parse_scene_toml({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
  const fs::path folder = fs::path(path).parent_path();
  if (!is_gltf(toml.scene.path)) throw UserError(toml.scene.place + ": [scene] file must be a .glb or .gltf file");

  const std::string gltf = resolve(toml.scene, folder);
  loaded.files.push_back(gltf);
  loaded.scene = load_gltf(gltf, warn, &loaded.files);
  loaded.settings = toml.settings;
  if (toml.environment) {
    loaded.scene.environment = read_environment(*toml.environment, folder);
    loaded.files.push_back(resolve(toml.environment->file, folder));
  }
  add_media(toml.media, folder, budget, loaded.scene, loaded.files);
  return loaded;
}

}  // namespace isophote
