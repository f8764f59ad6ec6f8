#include "isophote/core/hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace isophote {
namespace {

// Flipping any bit of any argument flips each bit of the result with probability 1/2.
TEST(Hash, EveryInputBitReachesEveryOutputBit) {
  constexpr int trials = 2000;
  for (int argument = 0; argument < 3; ++argument)
    for (int in = 0; in < 64; ++in) {
      int flips[64] = {};
      for (std::uint64_t t = 0; t < trials; ++t) {
        std::uint64_t a[3] = {t, 2 * t + 1, 77};
        const std::uint64_t before = hash(a[0], a[1], a[2]);
        a[argument] ^= 1ull << in;
        const std::uint64_t changed = before ^ hash(a[0], a[1], a[2]);
        for (int out = 0; out < 64; ++out) flips[out] += changed >> out & 1;
      }
      // 12288 counts of a fair coin: six standard deviations leave a chance of 3e-5
      for (int out = 0; out < 64; ++out)
        EXPECT_NEAR(flips[out], trials / 2, 6 * std::sqrt(trials / 4.0)) << in << " " << out;
    }
}

TEST(Hash, TellsArgumentsAndTheirOrderApart) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t a = 0; a < 100; ++a) {
    EXPECT_TRUE(seen.insert(hash(a)).second);
    for (std::uint64_t b = 0; b < 100; ++b) EXPECT_TRUE(seen.insert(hash(a, b)).second);
  }
  EXPECT_NE(hash(1, 2, 3), hash(1, 3, 2));
}

TEST(Hash, UnitFloatsAreBelowOne) {
  EXPECT_EQ(unit_float(0), 0.0f);
  EXPECT_EQ(unit_float(0x80000000u), 0.5f);
  EXPECT_EQ(unit_float(0xffffffffu), 1 - 0x1p-24f);
}

}  // namespace
}  // namespace isophote
