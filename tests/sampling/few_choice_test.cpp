#include "isophote/sampling/few_choice.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace isophote {
namespace {

FewChoice choice_of(const std::vector<float>& weights) {
  return {weights.size(), [&](std::uint32_t i) { return weights[i]; }};
}

TEST(FewChoice, GivesEachIndexItsChance) {
  const std::vector<float> weights = {0, 3, 1e-6f, 0, 1, 0};
  const FewChoice choice = choice_of(weights);
  EXPECT_FLOAT_EQ(choice.chance(1), 0.9f * 3 / 4 + 0.1f / 3);
  EXPECT_NEAR(choice.chance(2), 0.1 / 3, 1e-6);
  constexpr int draws = 1 << 16;
  std::vector<int> drawn(weights.size());
  for (int i = 0; i < draws; ++i) ++drawn[choice.sample((static_cast<float>(i) + 0.5f) / draws)];
  double sum = 0;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(drawn[i], choice.chance(i) * draws, 1) << i;
    sum += choice.chance(i);
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(FewChoice, EndsAtAnIndexOfPositiveWeight) {
  EXPECT_EQ(choice_of({0, 1, 0, 2, 0}).sample(0), 1u);
  EXPECT_EQ(choice_of({0, 1, 0, 2, 0}).sample(1), 3u);
}

TEST(FewChoice, IsEmptyWithoutAFinitePositiveSum) {
  EXPECT_TRUE(choice_of({}).empty());
  EXPECT_TRUE(choice_of({0, 0}).empty());
  EXPECT_TRUE(choice_of({1, std::numeric_limits<float>::infinity()}).empty());
  EXPECT_FALSE(choice_of({0, 1e-30f}).empty());
}

}  // namespace
}  // namespace isophote
