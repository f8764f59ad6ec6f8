#include "isophote/load/memory_budget.h"

#include <fmt/format.h>

#include "isophote/core/error.h"

namespace isophote {

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
