#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "isophote/load/memory_budget.h"

namespace isophote {

/// The parts of a .glb, or of a .gltf, which is all JSON. Both refer to the file's bytes.
struct GltfContainer {
  std::string_view json;
  std::span<const unsigned char> binary;
};

/// Tells the two apart by the file's first bytes. Throws UserError for a broken or truncated .glb.
GltfContainer split_container(std::span<const unsigned char> bytes);

/// Parses text that may be hostile: its nesting (at most 128) and the memory its values take are checked before.
/// Throws UserError.
nlohmann::json parse_json(std::string_view text, MemoryBudget& budget);

}  // namespace isophote
