#pragma once

#include <string>

#include "isophote/core/hash.h"

namespace isophote::test {

/// The bytes of a record file with the checksum that belongs to them in the last eight, so that what is wrong with a
/// crafted file is found by what comes after the checksum. At least 8 bytes.
inline std::string sign_record_file(std::string bytes) {
  std::uint64_t sum = 0;
  const std::size_t end = bytes.size() - 8;
  for (std::size_t i = 0; i < end; ++i) sum = mix_bits(sum ^ static_cast<unsigned char>(bytes[i])) + i;
  for (int i = 0; i < 8; ++i) bytes[end + static_cast<std::size_t>(i)] = static_cast<char>(sum >> (8 * i));
  return bytes;
}

}  // namespace isophote::test
