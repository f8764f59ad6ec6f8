#include "isophote/validity/neighbour_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/records.h"

namespace isophote::test {
namespace {

std::vector<Record> scattered(int count, const Vec3& upper) {
  RandomPlaces random(11);
  std::vector<Record> records;
  for (int i = 0; i < count; ++i) {
    records.push_back(round_record(random.point({0, 0, 0}, upper), random.direction_near({0, 0, 1}, 2), 1));
    records.back().footprint.unscaled = std::pow(10.0f, random.number(-2, 0));
  }
  return records;
}

bool limits(const Record& by, const Record& other, float slope) {
  const float room = (other.footprint.unscaled - by.footprint.unscaled) / slope;
  return room > 0 && length_squared(other.position - by.position) < room * room && dot(by.normal, other.normal) > 0;
}

/// What the index says about each record, all others being known, is what looking at all pairs says.
void expect_brute_force(const NeighbourIndex& index, const std::vector<Record>& records, float slope) {
  for (const Record& r : records) {
    float expected = r.footprint.unscaled;
    std::vector<std::uint32_t> limited;
    for (std::uint32_t i = 0; i < records.size(); ++i) {
      const Record& other = records[i];
      if (limits(other, r, slope))
        expected = std::min(expected, other.footprint.unscaled + slope * length(other.position - r.position));
      if (limits(r, other, slope)) limited.push_back(i);
    }
    EXPECT_FLOAT_EQ(index.limit(r, slope), expected);
    std::vector<std::uint32_t> found = index.limited(r, slope);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, limited);
  }
}

// Within the bounds and beyond them, on a plane and in space, and with many records at one place.
TEST(NeighbourIndex, IsBruteForce) {
  for (const Vec3& upper : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{30, 1, 1}, Vec3{0, 0, 0}}) {
    std::vector<Record> records = scattered(400, upper);
    NeighbourIndex index({{0, 0, 0}, {1, 1, 1}});
    for (const Record& r : records) index.insert(r);
    for (const float slope : {1.0f, 0.5f}) expect_brute_force(index, records, slope);
    RandomPlaces random(5);
    for (std::uint32_t i = 0; i < records.size(); i += 3) {
      records[i].footprint.unscaled *= random.number(0.1f, 1);
      index.lower(i, records[i].footprint.unscaled);
    }
    for (const float slope : {1.0f, 0.5f}) expect_brute_force(index, records, slope);
  }
}

}  // namespace
}  // namespace isophote::test
