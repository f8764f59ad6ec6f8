#include "isophote/image/physical_memory.h"

#include <unistd.h>

namespace isophote {

std::uint64_t physical_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  constexpr std::uint64_t fallback = 4ull << 30;  // where the system does not say
  return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : fallback;
}

}  // namespace isophote
