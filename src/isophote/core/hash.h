#pragma once

#include <cstdint>

namespace isophote {

/// A bijection of 64-bit words in which every input bit reaches every output bit (the finalizer of SplitMix64).
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}
constexpr std::uint64_t hash(std::uint64_t a) { return mix_bits(a + 0x9e3779b97f4a7c15ull); }
template <class... Rest>
constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b, Rest... rest) {
  return hash(hash(a) ^ (b * 0xd1342543de82ef95ull + 1), static_cast<std::uint64_t>(rest)...);
}

/// A number in [0, 1) from the upper 24 bits of a 32-bit word.
constexpr float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace isophote
