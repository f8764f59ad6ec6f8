#pragma once

#include <cstdint>
#include <string>

#include "isophote/image/physical_memory.h"

namespace isophote {

/// What one load may allocate. Everything whose size a file decides is taken from it before it is allocated.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : total_(bytes), left_(bytes) {}

  /// Throws UserError `WHAT: does not fit in memory: ...` where less than `bytes` is left.
  void take(std::uint64_t bytes, const std::string& what);
  /// Returns what was taken and has been freed.
  void give_back(std::uint64_t bytes) { left_ += bytes; }

 private:
  std::uint64_t total_, left_;
};

}  // namespace isophote
