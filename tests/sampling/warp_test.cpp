#include "isophote/sampling/warp.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

TEST(Warp, CosineHemisphere) {
  statistics::expect_density([](Random& r) { return cosine_hemisphere(r.next2()); },
                             [](const Vec3& d) { return cosine_hemisphere_pdf(d.z); });
}

TEST(Warp, UniformSphere) {
  statistics::expect_density([](Random& r) { return uniform_sphere(r.next2()); },
                             [](const Vec3&) { return uniform_sphere_pdf(); });
}

TEST(Warp, UniformTriangle) {
  // The four triangles that halving the sides makes have equal areas; so have theirs.
  Random random(2);
  constexpr int draws = 100000, n = 8;
  std::vector<double> observed(2 * n * n), expected(2 * n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      expected[2 * (i * n + j)] = draws / double(n * n);
      if (i + j + 1 < n) expected[2 * (i * n + j) + 1] = draws / double(n * n);
    }
  for (int k = 0; k < draws; ++k) {
    const Vec2 b = uniform_triangle(random.next2());
    ASSERT_GE(1 - b.x - b.y, -1e-6);
    const float x = b.x * n, y = b.y * n;
    const int i = std::min(n - 1, static_cast<int>(x)), j = std::min(n - 1 - i, static_cast<int>(y));
    observed[2 * (i * n + j) + (x - i + y - j > 1 && i + j + 1 < n)] += 1;
  }
  EXPECT_GT(statistics::chi_squared_chance(observed, expected), 1e-4);
}

}  // namespace
}  // namespace isophote
