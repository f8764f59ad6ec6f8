#pragma once

#include <cstdint>
#include <istream>

namespace isophote {

/// Refuses an OpenEXR file whose header claims more than the file can hold, before anybody allocates what it claims:
/// attributes longer than the file, more chunks than its offset table has room for, more pixels than its compression
/// can pack, more than 2^28 pixels. Also refused: deep and multi-part files. Reads `file`, of `size` bytes, from its
/// start; throws std::runtime_error or Iex::BaseExc with the reason.
void check_exr_header(std::istream& file, std::uint64_t size);

}  // namespace isophote
