#pragma once

#include <array>

#include "isophote/load/gltf_textures.h"
#include "isophote/scene/material.h"

namespace isophote {

/// glTF material `index` with the supported extensions. Factors outside [0, 1] are clamped with a warning. Throws
/// UserError `materials[I] "NAME": reason`.
Material read_material(const GltfFile& file, std::size_t index, TextureTable& textures, const Warn& warn);

/// Every use of a texture that a material has, those without texture included.
std::array<const TextureUse*, 7> texture_uses(const Material& material);

}  // namespace isophote
