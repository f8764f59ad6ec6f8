#include "isophote/sampling/strata.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isophote {
namespace {

// Over every count of rings the horizon's cosine is exactly zero, and no direction leaves the hemisphere.
TEST(Strata, NothingIsTheRootOfANegativeNumber) {
  for (int m = 1; m <= 200; ++m) {
    const Strata strata{m, 4};
    EXPECT_EQ(strata.cos_edge(m), 0.0);
    EXPECT_EQ(strata.sin_edge(m), 1.0);
    EXPECT_EQ(strata.sin_edge(0), 0.0);
    for (int j = 0; j < m; ++j) {
      EXPECT_LT(strata.theta_edge(j), strata.theta_edge(j + 1));
      EXPECT_NEAR(std::pow(strata.sin_edge(j), 2) + std::pow(strata.cos_edge(j), 2), 1, 1e-15);
      for (const float u : {0.0f, 0.5f, 0x1.fffffep-1f}) {
        const Vec3 w = strata.direction(j, 3, {u, u});
        EXPECT_TRUE(is_finite(w) && w.z >= 0);
        EXPECT_NEAR(length(w), 1, 2e-7);
      }
    }
  }
}

}  // namespace
}  // namespace isophote
