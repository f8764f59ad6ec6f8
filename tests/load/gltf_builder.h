#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "isophote/core/error.h"
#include "isophote/load/gltf_bytes.h"

namespace isophote::testing {

using nlohmann::json;
using Bytes = std::vector<unsigned char>;

inline Bytes to_bytes(const std::string& text) { return {text.begin(), text.end()}; }

inline std::string base64(const Bytes& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

inline constexpr int ubyte_type = 5121, ushort_type = 5123, uint_type = 5125, float_type = 5126;

/// A glTF document put together in code: JSON to edit at will, and one buffer.
struct GltfBuilder {
  json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
  Bytes binary;

  std::size_t append(const char* array, json value) {
    document[array].push_back(std::move(value));
    return document[array].size() - 1;
  }

  /// A buffer view of these values, aligned to 4 bytes.
  template <class T>
  std::size_t view(const std::vector<T>& values, int stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4);
    const std::size_t offset = binary.size(), size = values.size() * sizeof(T);
    binary.resize(offset + size);
    std::memcpy(binary.data() + offset, values.data(), size);
    json v = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (stride != 0) v["byteStride"] = stride;
    return append("bufferViews", v);
  }

  std::size_t accessor(std::size_t view_id, const char* type, int component, std::size_t count,
                       std::size_t offset = 0) {
    return append("accessors", {{"bufferView", view_id},
                                {"byteOffset", offset},
                                {"componentType", component},
                                {"count", count},
                                {"type", type}});
  }
  /// A tightly packed accessor in its own view; `per` components an element.
  template <class T>
  std::size_t accessor(const std::vector<T>& values, const char* type, int component, std::size_t per) {
    return accessor(view(values), type, component, values.size() / per);
  }
  std::size_t vec3(const std::vector<float>& values) { return accessor(values, "VEC3", float_type, 3); }

  std::size_t mesh(json primitive, const std::string& name = "mesh") {
    return append("meshes", {{"name", name}, {"primitives", {std::move(primitive)}}});
  }
  /// A node that is a root of the scene.
  std::size_t node(json value) {
    const std::size_t id = append("nodes", std::move(value));
    document["scenes"][0]["nodes"].push_back(id);
    return id;
  }

  /// The triangle (0,0,0), (1,0,0), (0,1,0) as a mesh in a node; returns its primitive for edits.
  json& triangle() {
    const std::size_t positions = vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    node({{"mesh", mesh({{"attributes", {{"POSITION", positions}}}})}});
    return primitive();
  }
  json& primitive() { return document["meshes"].back()["primitives"][0]; }

  json complete(bool embed) const {
    json whole = document;
    if (!binary.empty() && !whole.contains("buffers")) {
      whole["buffers"] = {{{"byteLength", binary.size()}}};
      if (embed) whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(binary);
    }
    return whole;
  }
  std::string gltf() const { return complete(true).dump(); }

  Bytes glb() const {
    std::string text = complete(false).dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes padded = binary;
    padded.resize((padded.size() + 3) / 4 * 4);
    Bytes out;
    const auto word = [&](std::size_t value) {
      for (int i = 0; i < 4; ++i) out.push_back(static_cast<unsigned char>(value >> (8 * i)));
    };
    word(0x46546c67), word(2), word(12 + 8 + text.size() + 8 + padded.size());
    word(text.size()), word(0x4e4f534a), out.insert(out.end(), text.begin(), text.end());
    word(padded.size()), word(0x004e4942), out.insert(out.end(), padded.begin(), padded.end());
    return out;
  }
};

/// A scene and the warnings that loading it gave, or the error.
struct Loaded {
  Scene scene;
  std::vector<std::string> warnings;
  std::string error;
};

inline constexpr std::uint64_t plenty = 1ull << 30;

inline Loaded try_load(const Bytes& bytes, const std::filesystem::path& folder = "nowhere",
                       std::uint64_t memory = plenty) {
  Loaded loaded;
  try {
    loaded.scene = load_gltf_bytes(bytes, "test.gltf", folder, memory,
                                   [&](const std::string& line) { loaded.warnings.push_back(line); });
  } catch (const UserError& error) {
    loaded.error = error.what();
  }
  return loaded;
}
inline Loaded try_load(const GltfBuilder& builder, const std::filesystem::path& folder = "nowhere") {
  return try_load(to_bytes(builder.gltf()), folder);
}
/// For documents that must load.
inline Scene load(const GltfBuilder& builder) {
  Loaded loaded = try_load(builder);
  EXPECT_EQ(loaded.error, "");
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  return std::move(loaded.scene);
}

/// A folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "isophote-load-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const Bytes& bytes) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file.string();
  }
  std::string write(const std::string& name, const std::string& text) const { return write(name, to_bytes(text)); }

 private:
  std::filesystem::path path_;
};

}  // namespace isophote::testing
