#pragma once

#include <cstdint>
#include <istream>

namespace isophote {

/// What the header of an OpenEXR file asks for.
struct ExrClaim {
  std::uint64_t pixels = 0;
  std::uint64_t buffers = 0;  ///< bytes that OpenEXR itself takes to read it, about
};

/// Refuses an OpenEXR file whose header claims more than the file can hold, before anybody allocates what it claims:
/// attributes longer than the file, chunks that its offset table does not have or puts outside the file, more pixels
/// than its compression can pack, more than 2^28 pixels. Also refused: deep and multi-part files. Reads `file`, of
/// `size` bytes, from its start; throws std::runtime_error or Iex::BaseExc with the reason.
ExrClaim check_exr_header(std::istream& file, std::uint64_t size);

}  // namespace isophote
