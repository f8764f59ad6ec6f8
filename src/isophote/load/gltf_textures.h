#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "isophote/load/gltf_file.h"
#include "isophote/scene/texture.h"

namespace isophote {

/// The scene's textures, decoded when a material first asks for them. One that is read as sRGB here and as linear there
/// is kept twice.
class TextureTable {
 public:
  TextureTable(const GltfFile& file, MemoryBudget& budget) : file_(file), budget_(budget) {}

  /// The id of glTF texture `texture`, its colours sRGB or linear.
  int id(int texture, bool srgb);
  std::vector<Texture> take() { return std::move(textures_); }

 private:
  using Key = std::tuple<int, Wrap, Wrap, bool>;  // image, wrap modes, sRGB

  const GltfFile& file_;
  MemoryBudget& budget_;
  std::map<Key, int> ids_;
  std::vector<Texture> textures_;
};

}  // namespace isophote
