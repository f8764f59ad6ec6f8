#include "isophote/sampling/sampler.h"

#include <gtest/gtest.h>

#include <set>

#include "support/statistics.h"

namespace isophote {
namespace {

TEST(Sampler, EveryPairIsStratified) {
  // A (0,2)-sequence: of 256 points, each elementary interval of area 1/256 holds one.
  for (int pair = 0; pair < 4; ++pair)
    for (int shape = 0; shape <= 8; ++shape) {
      std::set<int> seen;
      for (std::uint32_t i = 0; i < 256; ++i) {
        Sampler sampler(Purpose::test, 7, 9, i);
        Vec2 u;
        for (int k = 0; k <= pair; ++k) u = sampler.next2();
        const int columns = 1 << shape, rows = 256 >> shape;
        seen.insert(static_cast<int>(u.x * columns) * rows + static_cast<int>(u.y * rows));
      }
      EXPECT_EQ(seen.size(), 256u) << "pair " << pair << ", " << (1 << shape) << " columns";
    }
}

TEST(Sampler, PairsAreNotCorrelated) {
  std::vector<double> observed(256);
  for (std::uint32_t i = 0; i < 16384; ++i) {
    Sampler sampler(Purpose::test, 1, 2, i);
    const Vec2 a = sampler.next2(), b = sampler.next2();
    observed[static_cast<int>(a.x * 16) * 16 + static_cast<int>(b.y * 16)] += 1;
  }
  EXPECT_GT(statistics::chi_squared_chance(observed, std::vector<double>(256, 64.0)), 1e-4);
}

TEST(Sampler, KeysAreIndependentAndRepeatable) {
  std::vector<double> observed(256);
  for (std::uint32_t item = 0; item < 16384; ++item) {
    Sampler sampler(Purpose::test, 1, item, 0), again(Purpose::test, 1, item, 0);
    const Vec2 a = sampler.next2();
    EXPECT_EQ(a, again.next2());
    EXPECT_EQ(sampler.next_bits(), again.next_bits());
    observed[static_cast<int>(a.x * 16) * 16 + static_cast<int>(a.y * 16)] += 1;
  }
  EXPECT_GT(statistics::chi_squared_chance(observed, std::vector<double>(256, 64.0)), 1e-4);
  EXPECT_NE(Sampler(Purpose::camera, 1, 2, 3).next2(), Sampler(Purpose::record, 1, 2, 3).next2());
}

TEST(Sampler, BitsDifferByIndex) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < 1000; ++i) seen.insert(Sampler(Purpose::test, 1, 2, i).next_bits());
  EXPECT_GE(seen.size(), 999u);
}

}  // namespace
}  // namespace isophote
