#pragma once

#include <cstdint>

namespace isophote {

/// The machine's memory, in bytes.
std::uint64_t physical_memory();

}  // namespace isophote
