#include "isophote/load/memory_budget.h"

#include <fmt/format.h>
#include <unistd.h>

#include "isophote/core/error.h"

namespace isophote {

std::uint64_t physical_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  constexpr std::uint64_t fallback = 4ull << 30;  // where the system does not say
  return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : fallback;
}

void MemoryBudget::take(std::uint64_t bytes, const std::string& what) {
  if (bytes > left_) {
    constexpr double mebi = 1024.0 * 1024.0;
    throw UserError(fmt::format("{}: does not fit in memory: needs {:.1f} MiB, {:.1f} of {:.1f} MiB are left", what,
                                static_cast<double>(bytes) / mebi, static_cast<double>(left_) / mebi,
                                static_cast<double>(total_) / mebi));
  }
  left_ -= bytes;
}

}  // namespace isophote
