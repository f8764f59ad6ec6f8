#include "isophote/cache/octree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace isophote {
namespace {

struct Sphere {
  Vec3 center;
  float radius;

  bool contains(const Vec3& p) const { return length_squared(Vec3d(p) - Vec3d(center)) <= double(radius) * radius; }
};

class OctreeTest : public testing::Test {
 protected:
  float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  Vec3 point(const Box& box) {
    return {uniform(box.lower.x, box.upper.x), uniform(box.lower.y, box.upper.y), uniform(box.lower.z, box.upper.z)};
  }

  /// Every sphere that contains `p` is offered, and hardly another; returns how many others lie near.
  static std::size_t expect_all_found(const Octree& octree, const std::vector<Sphere>& spheres, const Vec3& p) {
    std::set<std::uint32_t> offered, near;
    octree.any(p, [&](std::uint32_t id) {
      EXPECT_TRUE(offered.insert(id).second) << id << " offered twice";
      return false;
    });
    octree.visit_near(p, [&](std::uint32_t id) { near.insert(id); });
    for (std::uint32_t id = 0; id < spheres.size(); ++id) {
      const Sphere grown{spheres[id].center, spheres[id].radius * (1 + 0x1p-16f)};
      const bool found = offered.count(id) > 0;
      EXPECT_TRUE(found || !spheres[id].contains(p)) << id << " of radius " << spheres[id].radius;
      EXPECT_TRUE(!found || (grown.contains(p) && near.count(id))) << id << " of radius " << spheres[id].radius;
    }
    return near.size() - offered.size();
  }

  static Octree index(const Box& bounds, const std::vector<Sphere>& spheres) {
    Octree octree(bounds);
    for (std::uint32_t id = 0; id < spheres.size(); ++id) octree.insert(id, spheres[id].center, spheres[id].radius);
    return octree;
  }

  std::mt19937 random_{1};
};

// Radii over nine decades, in rooms at the origin and far from it, where floats are coarse; points anywhere, on the
// spheres themselves, and on the planes between cells.
TEST_F(OctreeTest, AgreesWithBruteForce) {
  for (const Vec3& offset : {Vec3{0, 0, 0}, Vec3{1000, -300, 77}}) {
    const Box room{Vec3{0, 0, 0} + offset, Vec3{4, 3, 2.5f} + offset};
    std::vector<Sphere> spheres;
    for (int i = 0; i < 1500; ++i) spheres.push_back({point(room), std::pow(10.0f, uniform(-7, 2))});
    const Octree octree = index(room, spheres);
    for (int i = 0; i < 1000; ++i) expect_all_found(octree, spheres, point(room));
    for (const Sphere& s : spheres) {
      expect_all_found(octree, spheres, s.center);
      const Vec3 towards = normalize(point({{-1, -1, -1}, {1, 1, 1}}));
      expect_all_found(octree, spheres, s.center + towards * (s.radius * 0.9999f));
    }
    for (int i = 0; i < 500; ++i) {
      Vec3 p = point(room);
      const int axis = i % 3;
      p[axis] = room.center()[axis] + static_cast<float>(i % 17 - 8) / 64 * 4;
      expect_all_found(octree, spheres, p);
    }
  }
}

TEST_F(OctreeTest, HoldsWhatLiesOutsideItsBounds) {
  const Box room{{0, 0, 0}, {4, 3, 2.5f}}, wide{{-8, -8, -8}, {12, 12, 12}};
  std::vector<Sphere> spheres;
  for (int i = 0; i < 1000; ++i) spheres.push_back({point(wide), std::pow(10.0f, uniform(-5, 0.5f))});
  const Octree octree = index(room, spheres);
  for (int i = 0; i < 2000; ++i) expect_all_found(octree, spheres, point(wide));
  for (const Sphere& s : spheres) expect_all_found(octree, spheres, s.center + Vec3{0, 0, s.radius * 0.99f});
}

TEST_F(OctreeTest, FlatPointLikeAndEmptyBounds) {
  for (const Box& bounds : {Box{{0, 0, 1}, {4, 3, 1}}, Box{{1, 1, 1}, {1, 1, 1}}, Box{}}) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 300; ++i) spheres.push_back({point({{0, 0, 1}, {4, 3, 1}}), std::pow(10.0f, uniform(-6, 1))});
    const Octree octree = index(bounds, spheres);
    for (int i = 0; i < 500; ++i) expect_all_found(octree, spheres, point({{0, 0, 1}, {4, 3, 1}}));
  }
}

// It is an index: of small spheres spread over a room, a query is offered few that do not contain it.
TEST_F(OctreeTest, OffersFewOthers) {
  const Box room{{0, 0, 0}, {4, 4, 4}};
  std::vector<Sphere> spheres;
  for (int i = 0; i < 20000; ++i) spheres.push_back({point(room), uniform(0.02f, 0.05f)});
  const Octree octree = index(room, spheres);
  std::size_t others = 0;
  for (int i = 0; i < 1000; ++i) others += expect_all_found(octree, spheres, point(room));
  EXPECT_LT(others / 1000.0,
            2 * 20000 * std::pow(4 * 0.05 / 4, 3));  // about what the largest cells around a point may hold
}

TEST_F(OctreeTest, StopsWhereTheTestHolds) {
  Octree octree({{0, 0, 0}, {1, 1, 1}});
  for (std::uint32_t id = 0; id < 4; ++id) octree.insert(id, {0.5f, 0.5f, 0.5f}, 0.2f);
  std::vector<std::uint32_t> asked;
  EXPECT_TRUE(octree.any({0.4f, 0.4f, 0.4f}, [&](std::uint32_t id) { return asked.push_back(id), id == 2; }));
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace isophote
