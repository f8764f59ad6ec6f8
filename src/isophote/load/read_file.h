#pragma once

#include <filesystem>
#include <vector>

#include "isophote/load/memory_budget.h"

namespace isophote {

/// The bytes of a regular file. Throws UserError with the bare reason ("no such file", "is a directory", ...).
std::vector<unsigned char> read_file(const std::filesystem::path& path, MemoryBudget& budget);

}  // namespace isophote
