#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "isophote/load/memory_budget.h"

namespace isophote {

/// The file that a glTF `uri` names, in `folder` or below; nothing for data URIs. Throws UserError as `read_resource`.
std::optional<std::filesystem::path> resource_file(const std::string& uri, const std::filesystem::path& folder);

/// The bytes that a glTF `uri` stands for: a base64 data URI, or a file in `folder` or below (percent-decoded; absolute
/// paths, other schemes and paths that leave the folder are refused). Throws UserError naming the uri.
std::vector<unsigned char> read_resource(const std::string& uri, const std::filesystem::path& folder,
                                         MemoryBudget& budget);

}  // namespace isophote
