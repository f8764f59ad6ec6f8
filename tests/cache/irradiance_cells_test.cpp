#include "isophote/cache/irradiance_cells.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isophote::test {
namespace {

constexpr Box room{{-1, 0, 2}, {3, 2, 5}};
constexpr Vec3 up{0, 1, 0};

TEST(IrradianceCells, KeepSumsByKey) {
  IrradianceCells cells(room);
  const auto a = cells.key({0, 0, 3}, up, 1), b = cells.key({2, 0, 3}, up, 1);
  ASSERT_NE(a, b);
  EXPECT_EQ(cells.find(a), nullptr);
  cells.add({.key = a, .count = 1, .sum = Rgb(2), .nearest = 3, .position = {0, 0, 3}, .normal = up});
  cells.add({.key = b, .count = 1, .sum = Rgb(5), .nearest = 4});
  cells.add({.key = a, .count = 2, .sum = Rgb(1), .nearest = 0.5f, .position = {9, 9, 9}});
  cells.add({.key = b, .cut = true});
  ASSERT_NE(cells.find(a), nullptr);
  EXPECT_EQ(cells.find(a)->count, 3u);
  EXPECT_EQ(cells.find(a)->sum, Rgb(3));
  EXPECT_EQ(cells.find(a)->nearest, 0.5f);
  EXPECT_EQ(cells.find(a)->position, (Vec3{0, 0, 3})) << "that of the first sample";
  EXPECT_FALSE(cells.find(a)->cut);
  EXPECT_TRUE(cells.find(b)->cut);
  ASSERT_EQ(cells.cells().size(), 2u);
  EXPECT_EQ(cells.cells()[1].key, b);
}

TEST(IrradianceCells, PartSidesAndGrids) {
  const IrradianceCells cells(room);
  const Vec3 p{0.3f, 0.7f, 3.1f};
  std::vector<std::uint64_t> keys;
  for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}})
    for (const float distance : {0.01f, 5.0f}) keys.push_back(cells.key(p, n, distance));
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
  EXPECT_EQ(cells.key(p, normalize(Vec3{0.5f, 0.8f, 0.1f}), 1), cells.key(p, up, 1)) << "by the greatest component";
}

/// No point lies further from another of its cell than the cell is long; all points of the room have one, and points
/// that rounding left outside too.
TEST(IrradianceCells, AreAsLargeAsTheySay) {
  const IrradianceCells cells(room);
  EXPECT_FLOAT_EQ(cells.edge(cells.key({0, 0, 3}, up, 100)), room.diagonal() / 32);
  EXPECT_FLOAT_EQ(cells.edge(cells.key({0, 0, 3}, up, 0.01f)), room.diagonal() / 512);
  for (const float distance : {0.01f, 100.0f}) {
    const float edge = cells.edge(cells.key({}, up, distance));
    for (float x = room.lower.x; x < room.upper.x; x += 0.37f * edge) {
      const Vec3 p{x, 0.01f, 3};
      EXPECT_NE(cells.key(p, up, distance), cells.key(p + Vec3{1.001f * edge, 0, 0}, up, distance));
      EXPECT_NE(cells.key(p, up, distance), cells.key(p + Vec3{0, 0, 1.001f * edge}, up, distance));
    }
  }
  cells.key(room.lower - Vec3{1, 1, 1} * 1e-4f, up, 1);
  cells.key(room.upper + Vec3{1, 1, 1} * 1e9f, up, 1);
}

TEST(IrradianceCells, AreTheSameAtAnyPowerOfTwo) {
  for (const float scale : {0x1p-20f, 0x1p20f}) {
    const IrradianceCells cells(room), scaled(Box{room.lower * scale, room.upper * scale});
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = room.lower + room.size() * (static_cast<float>(i) / 100);
      EXPECT_EQ(cells.key(p, up, 0.1f * static_cast<float>(i)),
                scaled.key(p * scale, up, 0.1f * static_cast<float>(i) * scale));
    }
  }
}

TEST(IrradianceCells, StopAtTheirMost) {
  IrradianceCells cells(room);
  for (std::uint64_t key = 0; key < IrradianceCells::most_cells + 1000; ++key)
    cells.add({.key = key, .count = 1, .sum = Rgb(1)});
  EXPECT_EQ(cells.cells().size(), IrradianceCells::most_cells);
  EXPECT_EQ(cells.find(IrradianceCells::most_cells + 1), nullptr);
  cells.add({.key = 7, .count = 1, .sum = Rgb(1)});
  EXPECT_EQ(cells.find(7)->count, 2u);
}

}  // namespace
}  // namespace isophote::test
