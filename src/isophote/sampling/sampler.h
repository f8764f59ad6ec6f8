#pragma once

#include <cstdint>

#include "isophote/core/hash.h"
#include "isophote/core/vec.h"

namespace isophote {

/// What a stream of random numbers is for; streams of different purpose never share numbers.
enum class Purpose : std::uint64_t { camera, record, check, pilot, test };

/// A deterministic stream of points of the unit square: sample `index` of an Owen-scrambled (0,2)-sequence in every
/// pair of dimensions, the pairs decorrelated by shuffling [Burley 2020]. Samples 0..n-1 of one key are stratified over
/// each pair; streams of different keys are independent. No state is shared: any thread may make any stream.
class Sampler {
 public:
  Sampler(std::uint64_t key, std::uint32_t index) : key_(key), index_(index) {}
  Sampler(Purpose purpose, std::uint64_t seed, std::uint64_t item, std::uint32_t index)
      : Sampler(hash(static_cast<std::uint64_t>(purpose), seed, item), index) {}

  /// The next pair of numbers, each in [0, 1).
  Vec2 next2() {
    const std::uint64_t scramble = hash(key_, ++dimension_);
    const auto low = static_cast<std::uint32_t>(scramble), high = static_cast<std::uint32_t>(scramble >> 32);
    const std::uint32_t i = owen_scramble(index_, low ^ high);
    return {unit_float(owen_scramble(van_der_corput(i), low)), unit_float(owen_scramble(sobol_second(i), high))};
  }
  float next() { return next2().x; }
  /// 32 bits for whoever needs a seed of their own.
  std::uint32_t next_bits() { return static_cast<std::uint32_t>(hash(key_, ++dimension_, index_)); }

 private:
  static std::uint32_t reverse(std::uint32_t v) {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(v);
  }
  /// Owen scrambling of the bits of `v`, most significant first, by the hash of [Burley 2020].
  static std::uint32_t owen_scramble(std::uint32_t v, std::uint32_t seed) {
    v = reverse(v);
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return reverse(v);
  }
  static std::uint32_t van_der_corput(std::uint32_t i) { return reverse(i); }
  /// The second dimension of the Sobol sequence.
  static std::uint32_t sobol_second(std::uint32_t i) {
    // Its matrix is Pascal's triangle modulo 2, the Kronecker power of [1 1; 0 1]: one step for each factor.
    std::uint32_t v = reverse(i);
    v ^= (v & 0x0000ffffu) << 16;
    v ^= (v & 0x00ff00ffu) << 8;
    v ^= (v & 0x0f0f0f0fu) << 4;
    v ^= (v & 0x33333333u) << 2;
    v ^= (v & 0x55555555u) << 1;
    return v;
  }

  std::uint64_t key_;
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

}  // namespace isophote
