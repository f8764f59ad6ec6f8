#include "isophote/derivatives/obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "isophote/derivatives/sphere_gather.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "support/records.h"

namespace isophote::test {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr Vec3 here{3, -1, 2};

/// A gather at `here` of what `distance(local direction)` says: infinity for the sky.
template <class Distance>
HemisphereGather gather_of(const Vec3& normal, Strata strata, RandomPlaces& random, const Distance& distance) {
  HemisphereGather gather{here, Frame(normal), strata, {}};
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) {
      const Vec3 local = strata.direction(j, k, {random.number(0, 1), random.number(0, 1)});
      gather.samples.push_back({gather.frame.to_world(local), distance(local), Rgb(1), {0, 0, 1}, 0});
    }
  return gather;
}

Vec3 level(const Frame& frame, double azimuth, double distance) {
  return frame.to_world(
      {static_cast<float>(distance * std::cos(azimuth)), static_cast<float>(distance * std::sin(azimuth)), 0});
}

TEST(Obstacles, SectorsGoOnceRoundAndAreAboutAsWide) {
  std::vector<int> counts(Obstacles::sectors);
  int steps = 0, last = Obstacles::sector(1, -0.9999f);
  constexpr int directions = 36000;
  for (int i = 0; i < directions; ++i) {
    const double phi = turn * (i + 0.5) / directions - std::numbers::pi / 4;
    const int sector = Obstacles::sector(static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)));
    ASSERT_TRUE(sector == last || sector == (last + 1) % Obstacles::sectors) << phi;
    steps += sector != last;
    last = sector;
    ++counts[sector];
  }
  EXPECT_LE(steps, Obstacles::sectors);
  for (const int count : counts) EXPECT_NEAR(360.0 * count / directions, 22.5, 4.6);
  EXPECT_EQ(Obstacles::sector(0, 0), 0);
}

TEST(Obstacles, DistancesAreRoundedDownByLittle) {
  Obstacles o;
  EXPECT_EQ(o.distance(3), infinity);
  for (const float d : {1e20f, 2.999f, 1.0f, 0.7f, 1e-20f, 0.0f}) {
    o.meet(3, d);
    EXPECT_LE(o.distance(3), d);
    EXPECT_GE(o.distance(3), d * (1 - 0x1p-7f));
    o.meet(3, 2 * d);
    EXPECT_LE(o.distance(3), d);
  }
  EXPECT_EQ(o.distance(2), infinity);
}

TEST(Obstacles, TheOpenSkyIsNoneAndNorIsTheOwnSurface) {
  RandomPlaces random(5);
  const HemisphereGather gather =
      gather_of({0, 0, 1}, Strata::about(200), random, [](const Vec3&) { return infinity; });
  EXPECT_EQ(obstacles(gather), Obstacles{});
  EXPECT_EQ(irradiance(gather).distances.obstacles, Obstacles{});
}

// A wall on the ground that all of the lowest ring meets: whatever lies behind it is suspected; what lies well before
// it or away from it is not.
TEST(Obstacles, WhatLiesBehindAWallIsSuspected) {
  RandomPlaces random(7);
  for (const Strata strata : {Strata{4, 12}, Strata{8, 25}, Strata{16, 50}, Strata{32, 100}}) {
    int suspected = 0, before_wall = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 normal = random.direction();
      const float distance = random.number(0.01f, 3), widest = 1.9f;  // 1 / cos 1
      const float height = widest * distance * random.number(1, 3) / std::sqrt(static_cast<float>(strata.polar - 1));
      const double towards = random.number(0, static_cast<float>(turn));
      const HemisphereGather gather = gather_of(normal, strata, random, [&](const Vec3& d) {
        const float along = d.x * static_cast<float>(std::cos(towards)) + d.y * static_cast<float>(std::sin(towards));
        const float t = distance / along;
        return along > 0 && t * d.z < height ? t : infinity;
      });
      const Obstacles seen = irradiance(gather).distances.obstacles;
      for (int j = 0; j < 50; ++j) {
        const double off = random.number(-1, 1);
        const double wall = distance / std::cos(off);
        // Just behind a wall without thickness.
        EXPECT_TRUE(seen.before(level(gather.frame, towards + off, wall * 1.001), normal)) << off;
        EXPECT_FALSE(seen.before(level(gather.frame, towards + off / 3 + turn / 2, wall), normal));
        suspected += seen.before(level(gather.frame, towards + off, distance * 0.75), normal);
        ++before_wall;
      }
    }
    EXPECT_LT(suspected, 0.001 * before_wall);
  }
}

// A table leg, 4 cm wide and 70 cm high, from 30 cm away: seen as often as its width spans a stratum or more.
TEST(Obstacles, ALegIsFound) {
  RandomPlaces random(11);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const double towards = random.number(0, static_cast<float>(turn));
    const HemisphereGather gather = gather_of({0, 1, 0}, Strata::about(800), random, [&](const Vec3& d) {
      const float level_part = std::hypot(d.x, d.y);
      const double off = std::remainder(std::atan2(d.y, d.x) - towards, turn);
      return std::abs(off) < 0.02 / 0.3 && d.z / level_part * 0.3f < 0.7f ? 0.3f / level_part : infinity;
    });
    found += obstacles(gather).before(level(gather.frame, towards, 0.35), {0, 1, 0});
  }
  EXPECT_GT(found, 297);
}

// A board overhead hides what is on it, however steeply above, and nothing nearer than it is high.
TEST(Obstacles, ABoardOverhead) {
  RandomPlaces random(13);
  const Vec3 normal{0, 0, 1};
  const HemisphereGather gather =
      gather_of(normal, Strata::about(200), random, [](const Vec3& d) { return 0.12f / d.z; });
  const Obstacles seen = obstacles(gather);
  for (int i = 0; i < 200; ++i) {
    const double phi = random.number(0, static_cast<float>(turn)), across = random.number(0, 0.5f);
    EXPECT_TRUE(seen.before(level(gather.frame, phi, across) + normal * 0.121f, normal));
    EXPECT_FALSE(seen.before(level(gather.frame, phi, 0.09), normal));
  }
}

// Nor does it help a query that the board ends close to its side of the record, where few rays go so steeply.
TEST(Obstacles, TheEdgeOfABoardOverhead) {
  RandomPlaces random(14);
  const Vec3 normal{0, 0, 1};
  const HemisphereGather gather = gather_of(normal, Strata::about(200), random, [](const Vec3& d) {
    const float distance = 0.12f / d.z;
    return distance * d.x > -0.002f ? distance : infinity;
  });
  const Obstacles seen = obstacles(gather);
  for (int i = 0; i < 200; ++i) {
    const double phi = random.number(0, static_cast<float>(turn)), across = random.number(0, 0.1f);
    EXPECT_TRUE(seen.before(level(gather.frame, phi, across) + normal * 0.121f, normal));
  }
}

TEST(Obstacles, OfThreeStrataEachCountsAllRound) {
  RandomPlaces random(17);
  const HemisphereGather gather = gather_of({0, 0, 1}, {1, 3}, random, [](const Vec3&) { return 2.0f; });
  for (int i = 0; i < Obstacles::sectors; ++i) EXPECT_LE(obstacles(gather).distance(i), 2);
}

/// A gather at the origin of a plate in the plane x = 1, with |y|, |z| < 0.5, before the sky.
SphereGather plate_in_the_sky(SphereStrata strata) {
  SphereGather gather;
  gather.strata = strata;
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) {
      const Vec3 w = strata.direction(j, k, {0.5f, 0.5f});
      const bool met = w.x > 0 && std::abs(w.y) < 0.5f * w.x && std::abs(w.z) < 0.5f * w.x;
      gather.samples.push_back({w, met ? 1 / w.x : infinity, Rgb(1), {-1, 0, 0}, 0});
    }
  return gather;
}

TEST(Obstacles, AroundAPlace) {
  RandomPlaces random(19);
  for (const SphereStrata strata : {SphereStrata{10, 20}, SphereStrata{20, 40}, SphereStrata{41, 83}}) {
    const ObstaclesAround seen = obstacles(plate_in_the_sky(strata));
    for (int i = 0; i < 300; ++i) {
      const Vec3 q = random.point({-2, -2, -2}, {2, 2, 2});
      const bool hidden = q.x > 1 && std::abs(q.y) < 0.5f * q.x && std::abs(q.z) < 0.5f * q.x;
      EXPECT_TRUE(seen.before(q) || !hidden);
      const bool free = q.x < 0.25f * std::max(std::abs(q.y), std::abs(q.z)) || length(q) < 0.79f;
      EXPECT_FALSE(seen.before(q) && free);
    }
  }
  EXPECT_FALSE(ObstaclesAround{}.before({1e6f, 0, 0}));
}

TEST(Obstacles, SectorsAroundAPlaceAreAboutAsLarge) {
  std::array<int, ObstaclesAround::sectors> counts{};
  constexpr SphereStrata strata{120, 240};
  for (int j = 0; j < strata.polar; ++j)
    for (int k = 0; k < strata.azimuthal; ++k) ++counts[ObstaclesAround::sector(strata.direction(j, k, {0.5f, 0.5f}))];
  for (const int count : counts) EXPECT_NEAR(24.0 * count / strata.size(), 1, 0.02);
}

}  // namespace
}  // namespace isophote::test
