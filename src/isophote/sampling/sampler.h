#pragma once

#include <cstdint>

#include "isophote/core/hash.h"
#include "isophote/core/vec.h"

namespace isophote {

/// What a stream of random numbers is for; streams of different purpose never share numbers.
enum class Purpose : std::uint64_t { camera, record, check, test, pilot };

/// A deterministic stream of points of the unit square: sample `index` of an Owen-scrambled (0,2)-sequence in every
/// pair of dimensions, the pairs decorrelated by shuffling [Burley 2020]. Samples 0..n-1 of one key are stratified over
/// each pair; streams of different keys are independent. No state is shared: any thread may make any stream.
class Sampler {
 public:
  Sampler(std::uint64_t key, std::uint32_t index) : key_(hash(key)), index_(index), reversed_index_(reverse(index)) {}
  Sampler(Purpose purpose, std::uint64_t seed, std::uint64_t item, std::uint32_t index)
      : Sampler(hash(static_cast<std::uint64_t>(purpose), seed, item), index) {}

  /// The next pair of numbers, each in [0, 1).
  Vec2 next2() {
    const std::uint64_t key = next_key();
    const auto low = static_cast<std::uint32_t>(key), high = static_cast<std::uint32_t>(key >> 32);
    const std::uint32_t i = reverse(permute(reversed_index_, low ^ high));  // the index, Owen-scrambled
    // Element i of the sequence is (reverse(i), reverse(pascal(i))), and scrambling reverses, permutes and reverses.
    return {unit_float(reverse(permute(i, low))), unit_float(reverse(permute(pascal(i), high)))};
  }
  float next() { return next2().x; }
  /// 32 bits for whoever needs a seed of their own.
  std::uint32_t next_bits() { return static_cast<std::uint32_t>(mix_bits(next_key() ^ index_)); }

 private:
  /// A key for the next dimension, shared by all samples of the stream (SplitMix64).
  std::uint64_t next_key() { return mix_bits(key_ += 0x9e3779b97f4a7c15ull); }

  static std::uint32_t reverse(std::uint32_t v) {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(v);
  }
  /// A permutation in which each bit depends on itself and those below: between two reversals it is an Owen scrambling
  /// [Burley 2020].
  static std::uint32_t permute(std::uint32_t v, std::uint32_t seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
  }
  /// The second dimension of the Sobol sequence, bits reversed. Its matrix is Pascal's triangle modulo 2, the Kronecker
  /// power of [1 1; 0 1]: one step for each factor.
  static std::uint32_t pascal(std::uint32_t v) {
    v ^= v >> 16;
    v ^= (v >> 8) & 0x00ff00ffu;
    v ^= (v >> 4) & 0x0f0f0f0fu;
    v ^= (v >> 2) & 0x33333333u;
    v ^= (v >> 1) & 0x55555555u;
    return v;
  }

  std::uint64_t key_;
  std::uint32_t index_, reversed_index_;
};

}  // namespace isophote
