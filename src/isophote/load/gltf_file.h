#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "isophote/load/gltf.h"
#include "isophote/load/memory_budget.h"

namespace isophote {

/// Where an image's bytes are: a uri, or a buffer view. They are read when a material asks for them.
struct ImageSource {
  std::string name, uri;
  int buffer_view = -1;
};

/// A parsed glTF document. Every index in it is in range, every buffer has its `byteLength` bytes, and every buffer
/// view lies inside its buffer. `model.images` is empty: `images` stands for it.
struct GltfFile {
  tinygltf::Model model;
  std::vector<ImageSource> images;
  std::filesystem::path folder;    ///< against which uris are resolved
  std::vector<std::string> files;  ///< that it names, of buffers and images
};

/// Parses the bytes of a .gltf or .glb. Throws UserError `PLACE: reason`.
GltfFile parse_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& folder, MemoryBudget& budget,
                    const Warn& warn);

}  // namespace isophote
