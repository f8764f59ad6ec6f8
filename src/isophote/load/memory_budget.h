#pragma once

#include <cstdint>
#include <string>

namespace isophote {

/// The machine's memory, in bytes.
std::uint64_t physical_memory();

/// What one load may allocate. Everything whose size a file decides is taken from it before it is allocated.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : total_(bytes), left_(bytes) {}

  /// Throws UserError `WHAT: does not fit in memory: ...` where less than `bytes` is left.
  void take(std::uint64_t bytes, const std::string& what);

 private:
  std::uint64_t total_, left_;
};

}  // namespace isophote
