#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "isophote/load/gltf.h"

namespace isophote {

/// `load_gltf` for a file whose bytes are in memory. `name` stands before every message, `folder` is what uris are
/// relative to, and no more than `memory` bytes are used.
Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& name,
                      const std::filesystem::path& folder, std::uint64_t memory, const Warn& warn);

}  // namespace isophote
