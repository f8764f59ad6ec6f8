#include "isophote/load/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "isophote/load/gltf_container.h"
#include "isophote/load/gltf_resources.h"
#include "isophote/load/gltf_schema.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 7> supported_extensions{
    "KHR_lights_punctual",  "KHR_materials_emissive_strength", "KHR_materials_specular",
    "KHR_materials_ior",    "KHR_materials_transmission",      "KHR_materials_volume",
    "KHR_texture_transform"};

std::vector<std::string> extension_list(const json& document, const char* key) {
  std::vector<std::string> names;
  const auto list = document.find(key);
  if (list == document.end()) return names;
  if (!list->is_array()) throw UserError(fmt::format("{}: must be an array", key));
  for (const json& name : *list) {
    if (!name.is_string()) throw UserError(fmt::format("{}: must hold strings", key));
    const auto text = name.get<std::string>();
    if (std::find(supported_extensions.begin(), supported_extensions.end(), text) == supported_extensions.end())
      names.push_back(text);
  }
  return names;
}

void check_extensions(const json& document, const Warn& warn) {
  const auto required = extension_list(document, "extensionsRequired");
  if (!required.empty()) throw UserError("requires the extension " + required.front() + ", which is not supported");
  for (const std::string& name : extension_list(document, "extensionsUsed"))
    warn("extension " + name + " is not supported and ignored");
}

bool has_elements(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_array() && !found->empty();
}

void warn_of_ignored(const json& document, const Warn& warn) {
  if (has_elements(document, "animations")) warn("animations are ignored: the scene is shown as authored");
  if (has_elements(document, "skins")) warn("skins are ignored: skinned meshes are shown in their node's place");
  if (!has_elements(document, "meshes")) return;
  for (const json& mesh : document["meshes"]) {
    if (!has_elements(mesh, "primitives")) continue;
    for (const json& primitive : mesh["primitives"])
      if (has_elements(primitive, "targets")) return warn("morph targets are ignored: meshes are shown at rest");
  }
}

void check_version(const json& document) {
  const auto& asset = document["asset"];
  const auto version = asset["version"].get<std::string>();
  const auto least = asset.value("minVersion", version);
  if (!version.starts_with("2.") || (least != version && least != "2.0"))
    throw UserError(fmt::format("asset: version {} is not supported, only glTF 2.0", least));
}

std::vector<ImageSource> take_images(json& document) {
  std::vector<ImageSource> images;
  for (json& image : document.value("images", json::array()))
    images.push_back(
        {image.value("name", std::string()), image.value("uri", std::string()), image.value("bufferView", -1)});
  document.erase("images");
  return images;
}

/// What the parser asks for instead of files: it finds each buffer under the name `buffer:INDEX`.
struct BufferSources {
  std::vector<std::string> uris;
  std::vector<std::uint64_t> lengths;
  std::span<const unsigned char> binary;  ///< the .glb's own, for a first buffer without uri
  std::filesystem::path folder;
  MemoryBudget* budget;

  std::vector<unsigned char> read(std::size_t i) const {
    const std::uint64_t length = lengths[i];
    if (length == 0) throw UserError("byteLength must be at least 1");
    std::vector<unsigned char> bytes;
    if (!uris[i].empty()) {
      bytes = read_resource(uris[i], folder, *budget);
    } else if (i == 0 && !binary.empty()) {
      budget->take(binary.size(), "buffer");
      bytes.assign(binary.begin(), binary.end());
    } else {
      throw UserError("has neither a uri nor the file's binary chunk");
    }
    if (bytes.size() < length)
      throw UserError(fmt::format("byteLength is {}, but there are only {} bytes", length, bytes.size()));
    bytes.resize(length);
    return bytes;
  }
};

constexpr std::string_view buffer_prefix = "buffer:";

BufferSources take_buffers(json& document) {
  BufferSources sources;
  if (!document.contains("buffers")) return sources;
  for (json& buffer : document["buffers"]) {
    sources.lengths.push_back(buffer["byteLength"].get<std::uint64_t>());
    sources.uris.push_back(buffer.value("uri", std::string()));
    buffer["uri"] = std::string(buffer_prefix) + std::to_string(sources.uris.size() - 1);
  }
  return sources;
}

bool read_buffer(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  const std::size_t i = std::stoul(name.substr(buffer_prefix.size()));
  *out = with_place(place_name("buffers", i, ""), [&] { return static_cast<const BufferSources*>(user)->read(i); });
  return true;
}

tinygltf::Model parse_model(const json& document, BufferSources& sources) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({[](const std::string&, void*) { return true; },
                         [](const std::string& path, void*) { return path; }, read_buffer, nullptr, &sources});
  tinygltf::Model model;
  std::string error, warning;
  const std::string text = document.dump();
  if (!parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned>(text.size()), ""))
    throw UserError("not valid glTF: " + error.substr(0, error.find('\n')));
  return model;
}

void check_views(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    const std::size_t size = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
      throw UserError(fmt::format("bufferViews[{}]: reaches beyond the {} bytes of its buffer", i, size));
  }
}

/// Of an image that no material asks for, the uri may be bad.
void add_file(const std::string& uri, GltfFile& file) {
  try {
    if (uri.empty()) return;
    if (const auto path = resource_file(uri, file.folder)) file.files.push_back(path->string());
  } catch (const UserError&) {
  }
}

}  // namespace

GltfFile parse_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& folder, MemoryBudget& budget,
                    const Warn& warn) {
  const GltfContainer container = split_container(bytes);
  json document = parse_json(container.json, budget);
  if (!document.is_object()) throw UserError("not valid glTF: the JSON is not an object");
  check_extensions(document, warn);
  warn_of_ignored(document, warn);
  apply_schema(document, budget);
  check_version(document);

  GltfFile file;
  file.folder = folder;
  file.images = take_images(document);
  BufferSources sources = take_buffers(document);
  sources.binary = container.binary;
  sources.folder = folder;
  sources.budget = &budget;
  file.model = parse_model(document, sources);
  check_views(file.model);
  for (const std::string& uri : sources.uris) add_file(uri, file);
  for (const ImageSource& image : file.images) add_file(image.uri, file);
  return file;
}

}  // namespace isophote
