#include "isophote/sampling/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/statistics.h"

namespace isophote {
namespace {

constexpr std::uint32_t grid = 1u << 24;

TEST(AliasTable, FollowsWeightsToTheGrid) {
  const std::vector<double> weights{3, 0, 1, 1e-3, 7, 2.5};
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const AliasTable table(weights);
  for (std::uint32_t i = 0; i < weights.size(); ++i) EXPECT_NEAR(table.probability(i), weights[i] / sum, 6.0 / grid);
  EXPECT_EQ(table.probability(1), 0);
}

TEST(AliasTable, ProbabilityIsExactlyWhatSampleDoes) {
  // So many entries that a grid cell is a third of one: rounding is large, and must be told.
  std::vector<double> weights(5000003);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 + std::sin(static_cast<double>(i));
  for (const std::size_t count : {std::size_t{7}, std::size_t{64}, weights.size()}) {
    const AliasTable table(std::span<const double>(weights).first(count));
    std::vector<std::uint32_t> seen(count);
    for (std::uint32_t k = 0; k < grid; ++k) ++seen[table.sample(static_cast<float>(k) * 0x1p-24f)];
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < count; ++i) wrong += table.probability(i) != static_cast<float>(seen[i]) / grid;
    EXPECT_EQ(wrong, 0u) << count;
  }
}

TEST(AliasTable, DependsOnRatiosOnly) {
  const std::vector<double> weights{0.3, 5, 1.7}, scaled{0.3 * 1024, 5 * 1024, 1.7 * 1024};
  const AliasTable a(weights), b(scaled);
  for (std::uint32_t k = 0; k < grid; k += 997) {
    const float u = static_cast<float>(k) * 0x1p-24f;
    EXPECT_EQ(a.sample(u), b.sample(u));
  }
}

TEST(AliasTableDeathTest, EmptyOneIsNotSampled) { EXPECT_DEATH(AliasTable().sample(0.5f), "broken invariant"); }

TEST(AliasTable, IsEmptyWithoutWeight) {
  EXPECT_TRUE(AliasTable().empty());
  EXPECT_TRUE(AliasTable(std::vector<double>{}).empty());
  EXPECT_TRUE(AliasTable(std::vector<double>{0, 0}).empty());
}

const std::vector<float> cells{1, 2, 0, 5, 0, 0, 0, 0, 3, 0.5f, 0, 1};  // 4 x 3, a black row

TEST(Distribution2D, SamplesFollowTheDensity) {
  const Distribution2D distribution(cells, 4, 3);
  statistics::Random random(3);
  constexpr int draws = 100000;
  std::vector<double> observed(cells.size()), expected(cells.size());
  for (int i = 0; i < draws; ++i) {
    const Vec2 p = distribution.sample(random.next2());
    ASSERT_GT(distribution.pdf(p), 0);
    observed[static_cast<int>(p.y * 3) * 4 + static_cast<int>(p.x * 4)] += 1;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) expected[i] = cells[i] / 12.5 * draws;
  EXPECT_GT(statistics::chi_squared_chance(observed, expected), 1e-4);
}

TEST(Distribution2D, DensityIsTheWeightsShare) {
  const Distribution2D distribution(cells, 4, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_NEAR(distribution.pdf({(x + 0.3f) / 4, (y + 0.8f) / 3}), cells[y * 4 + x] / 12.5 * 12, 1e-5);
}

TEST(Distribution2D, IsMonotoneAndStaysInside) {
  const Distribution2D distribution(cells, 4, 3);
  float last = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = distribution.sample({0.5f, static_cast<float>(i) / 1000});
    EXPECT_GE(p.y, last);
    last = p.y;
  }
  const Vec2 corner = distribution.sample({0x1.fffffep-1f, 0x1.fffffep-1f});
  EXPECT_LT(corner.x, 1);
  EXPECT_LT(corner.y, 1);
}

TEST(Distribution2D, PointsLieInTheirCells) {
  // Every other column is black: a point that rounds into the next cell has no density. 25 columns round often.
  std::vector<float> weights(25 * 3, 0.0f);
  for (std::size_t i = 0; i < weights.size(); i += 2) weights[i] = 1 + static_cast<float>(i % 7);
  const Distribution2D distribution(weights, 25, 3);
  int outside = 0;
  for (std::uint32_t k = 0; k < grid; k += 61) {
    const float u = static_cast<float>(k) * 0x1p-24f;
    for (const float v : {0.0f, 0.4f, 0x1.fffffep-1f}) outside += !(distribution.pdf(distribution.sample({u, v})) > 0);
  }
  EXPECT_EQ(outside, 0);
}

TEST(Distribution2D, ProbabilityIsExactlyWhatSampleDoes) {
  // Weights far below a step of the random numbers, of about one, and of many.
  std::vector<float> weights{1, 1e-9f, 3e-8f, 2e-7f, 0.5f, 0, 4e-8f, 1e-3f};
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const Distribution2D distribution(weights, 8, 1);
  std::vector<std::uint32_t> seen(weights.size());
  float lowest = 1;
  for (std::uint32_t k = 0; k < grid; ++k) {
    const Vec2 p = distribution.sample({static_cast<float>(k) * 0x1p-24f, 0.5f});
    const auto cell = static_cast<int>(p.x * 8);
    ++seen[cell];
    if (cell == 2) lowest = std::min(lowest, p.x * 8 - 2);
  }
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(distribution.probability(x, 0), static_cast<float>(seen[x]) / grid) << x;
    EXPECT_NEAR(distribution.probability(x, 0), weights[x] / sum, 1.0 / grid);
  }
  EXPECT_EQ(seen[1], 0u);
  EXPECT_GT(lowest, 0.1f);  // one or few steps wide: sampled at their middles, not at its edge
}

TEST(Distribution2DDeathTest, RefusesWhatIsNotAWeightAndEmptyOnesAreNotSampled) {
  const std::vector<float> infinite{1, INFINITY}, nothing{1, NAN};
  EXPECT_DEATH(Distribution2D(infinite, 2, 1), "broken invariant");
  EXPECT_DEATH(Distribution2D(nothing, 2, 1), "broken invariant");
  EXPECT_DEATH(Distribution2D().sample({0.5f, 0.5f}), "broken invariant");
}

TEST(Distribution2D, IsEmptyWhereBlack) {
  EXPECT_TRUE(Distribution2D(std::vector<float>(6, 0.0f), 3, 2).empty());
  EXPECT_FALSE(Distribution2D(cells, 4, 3).empty());
}

}  // namespace
}  // namespace isophote
