#include "isophote/scene/density_grid.h"

#include <gtest/gtest.h>

#include <functional>

#include "isophote/core/error.h"
#include "support/statistics.h"

namespace isophote {
namespace {

using statistics::Random;

std::vector<float> filled(const std::array<int, 3>& size, const std::function<float(int, int, int)>& value) {
  std::vector<float> values;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) values.push_back(value(i, j, k));
  return values;
}

std::shared_ptr<const DensityGrid> noise(const std::array<int, 3>& size, const Affine& to_world = {}) {
  Random random(7);
  return DensityGrid::from_values(size, filled(size, [&](int, int, int) { return random.next(); }), to_world);
}

const Affine skewed{{0.5, 0.1, 0}, {-0.2, 0.4, 0.1}, {0, 0.3, -0.6}, {10, -20, 3}};

TEST(DensityGrid, InterpolatesWhatIsTrilinearExactly) {
  const auto f = [](double x, double y, double z) { return 1 + x + 2 * y + 3 * z + 0.5 * x * y + 0.25 * x * y * z; };
  const std::array<int, 3> size{5, 4, 6};
  const auto grid = DensityGrid::from_values(
      size, filled(size, [&](int i, int j, int k) { return static_cast<float>(f(i, j, k)); }), {});
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3d q{4.0 * random.next(), 3.0 * random.next(), 5.0 * random.next()};
    EXPECT_NEAR(grid->density_in_grid(q), f(q.x, q.y, q.z), 2e-5);
    const Vec3 gradient = grid->gradient(Vec3(q));
    EXPECT_NEAR(gradient.x, 1 + 0.5 * q.y + 0.25 * q.y * q.z, 3e-5);
    EXPECT_NEAR(gradient.y, 2 + 0.5 * q.x + 0.25 * q.x * q.z, 3e-5);
    EXPECT_NEAR(gradient.z, 3 + 0.25 * q.x * q.y, 3e-5);
  }
}

TEST(DensityGrid, FadesOutOverACellAndIsNothingBeyond) {
  const auto grid = DensityGrid::from_values({1, 1, 1}, {2}, {});
  EXPECT_EQ(grid->density({0, 0, 0}), 2);
  EXPECT_EQ(grid->density({0.5f, 0, 0}), 1);
  EXPECT_EQ(grid->density({-0.5f, 0.5f, 0}), 0.5f);
  for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 5}, Vec3{1e30f, 0, 0}, Vec3{0, -1e30f, 0}}) {
    EXPECT_EQ(grid->density(p), 0);
    EXPECT_EQ(grid->gradient(p + Vec3{0, 3, 0}), Vec3());
  }
  EXPECT_EQ(grid->grid_bounds().lower, Vec3(-1, -1, -1));
  EXPECT_EQ(grid->grid_bounds().upper, Vec3(1, 1, 1));
}

TEST(DensityGrid, WorldAndGridAgree) {
  const auto grid = noise({9, 7, 8}, skewed);
  const Box world = grid->world_bounds();
  Random random(2);
  for (int n = 0; n < 1000; ++n) {
    const Vec3d q{11.0 * random.next() - 1.5, 9.0 * random.next() - 1.5, 10.0 * random.next() - 1.5};
    const Vec3d p = skewed.point(q);
    EXPECT_NEAR(length(grid->to_grid(p) - q), 0, 1e-9);
    EXPECT_NEAR(length(grid->direction_to_grid(skewed.vector(q)) - q), 0, 1e-9);
    EXPECT_NEAR(grid->density(Vec3(p)), grid->density_in_grid(q), 1e-4);
    if (!(grid->density(Vec3(p)) > 0)) continue;
    for (int a = 0; a < 3; ++a) EXPECT_TRUE(Vec3(p)[a] >= world.lower[a] && Vec3(p)[a] <= world.upper[a]);
  }
}

TEST(DensityGrid, GradientIsTheSlopeInWorldSpace) {
  const auto grid = noise({9, 7, 8}, skewed);
  Random random(4);
  int inside = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3d q{11.0 * random.next() - 1.5, 9.0 * random.next() - 1.5, 10.0 * random.next() - 1.5};
    const double step = 1e-3;
    const auto cell = [](const Vec3d& v) { return Vec3d{std::floor(v.x), std::floor(v.y), std::floor(v.z)}; };
    const Vec3 p(skewed.point(q));
    const Vec3 gradient = grid->gradient(p);
    for (int a = 0; a < 3; ++a) {
      Vec3d d;
      d[a] = step;
      const Vec3d low = grid->to_grid(Vec3d(p) - d), high = grid->to_grid(Vec3d(p) + d);
      if (cell(low) != cell(high)) continue;
      ++inside;
      EXPECT_NEAR(gradient[a], (grid->density_in_grid(high) - grid->density_in_grid(low)) / (2 * step), 2e-3);
    }
  }
  EXPECT_GT(inside, 4000);
}

TEST(DensityGrid, MajorantsBoundWhatInterpolationGives) {
  // Values lie mostly at 0 with rare peaks, some at the borders of blocks, whose neighbours they reach.
  const std::array<int, 3> size{19, 17, 9};
  const auto value = [](int i, int j, int k) {
    return i == 8 && j == 8 && k == 4 ? 5.0f : i == 15 && j == 3 && k == 8 ? 3.0f : (i + j + k) % 7 == 0 ? 0.5f : 0.0f;
  };
  const auto grid = DensityGrid::from_values(size, filled(size, value), {});
  EXPECT_EQ(grid->majorant(), 5);
  for (const int i : {0, 1})
    for (const int j : {0, 1}) EXPECT_EQ(grid->block_majorant(i, j, 0), 5);
  EXPECT_EQ(grid->block_majorant(1, 0, 1), 3);
  EXPECT_EQ(grid->block_majorant(2, 0, 1), 0.5f);
  EXPECT_EQ(grid->block_majorant(-1, 0, 0), 0.5f);
  EXPECT_EQ(grid->block_majorant(-2, 0, 0), 0);
  EXPECT_EQ(grid->block_majorant(3, 0, 0), 0);
  Random random(5);
  for (int n = 0; n < 200000; ++n) {
    const Vec3d q{21.0 * random.next() - 1, 19.0 * random.next() - 1, 11.0 * random.next() - 1};
    const auto block = [](double x) { return static_cast<int>(std::floor(x / DensityGrid::block)); };
    ASSERT_LE(grid->density_in_grid(q), grid->block_majorant(block(q.x), block(q.y), block(q.z)) * (1 + 1e-6f));
  }
  EXPECT_NEAR(grid->density_in_grid({8 - 1e-6, 8 - 1e-6, 4}), 5, 1e-4);  // they are reached
}

TEST(DensityGrid, HashIsOfTheContent) {
  const auto grid = [](float value, const Affine& map, std::array<int, 3> size = {2, 1, 1}) {
    return DensityGrid::from_values(size, {1, value}, map)->content_hash();
  };
  EXPECT_EQ(grid(2, {}), grid(2, {}));
  EXPECT_NE(grid(2, {}), grid(2.0000002f, {}));
  EXPECT_NE(grid(2, {}), grid(2, skewed));
  EXPECT_NE(grid(2, {}), grid(2, {}, {1, 2, 1}));
}

TEST(DensityGrid, RefusesWhatIsNoDensity) {
  for (const float bad : {-1.0f, std::nanf(""), INFINITY}) try {
      DensityGrid::from_values({2, 1, 1}, {0, bad}, {});
      FAIL();
    } catch (const UserError& error) {
      EXPECT_STREQ(error.what(), "density at point (1, 0, 0) is negative or not a number");
    }
}

}  // namespace
}  // namespace isophote
