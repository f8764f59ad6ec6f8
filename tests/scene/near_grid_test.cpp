#include "isophote/scene/near_grid.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace isophote {
namespace {

TEST(NearGrid, MarksWhatIsWithinReach) {
  const Box bounds{{0, 0, 0}, {10, 1, 0}};  // flat
  const NearGrid grid(bounds, {{{{2, 0.5f, 0}, {2.5f, 0.5f, 0}}, 1}});
  EXPECT_TRUE(grid.marked({1.01f, 0.5f, 0}));
  EXPECT_TRUE(grid.marked({3.49f, 0.9f, 0}));
  EXPECT_FALSE(grid.marked({4, 0.5f, 0}));
  EXPECT_FALSE(grid.marked({0.5f, 0.5f, 0}));
  EXPECT_FALSE(NearGrid().marked({0, 0, 0}));
}

TEST(NearGrid, MarksTheUnionOfManyPlacesAndNoMoreThanACellAround) {
  const Box bounds{{-1, 2, 0}, {3, 5, 8}};
  statistics::Random random(5);
  const auto point = [&] {
    const Vec2 u = random.next2();
    return Vec3{-1 + 4 * u.x, 2 + 3 * u.y, 8 * random.next()};
  };
  std::vector<NearGrid::Place> places;
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = point();
    places.push_back({{p, p + Vec3{0.3f, 0, 0.2f} * random.next()}, 0.3f * random.next()});
  }
  const NearGrid grid(bounds, places);
  const auto within = [&](const Vec3& p, const Vec3& more) {
    for (const auto& [box, d] : places) {
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis)
        inside &= p[axis] >= box.lower[axis] - d - more[axis] && p[axis] <= box.upper[axis] + d + more[axis];
      if (inside) return true;
    }
    return false;
  };
  const Vec3 cell = bounds.size() * (1.001f / 64);
  int near = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = point();
    near += grid.marked(p);
    EXPECT_TRUE(grid.marked(p) || !within(p, {0, 0, 0}));
    EXPECT_TRUE(!grid.marked(p) || within(p, cell));
  }
  EXPECT_GT(near, 500);
  EXPECT_LT(near, 15000);
}

TEST(NearGrid, ManyLargePlaces) {
  const Box bounds{{-1, -1, -1}, {1, 1, 1}};
  const NearGrid grid(bounds, std::vector<NearGrid::Place>(20000, {bounds, 1}));
  EXPECT_TRUE(grid.marked({0, 0, 0}));
}

}  // namespace
}  // namespace isophote
