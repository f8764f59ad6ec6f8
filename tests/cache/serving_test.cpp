#include <gtest/gtest.h>

#include "isophote/cache/record_cache.h"
#include "support/records.h"

// Which records serve a place, and why the others do not.
namespace isophote::test {
namespace {

constexpr Box room{{0, 0, 0}, {4, 3, 2.5f}};
constexpr Vec3 up{0, 0, 1};

RecordCache crowded(RandomPlaces& random) {
  RecordCache cache(room);
  for (int i = 0; i < 2000; ++i) {
    Record r = round_record(random.point(room.lower, room.upper), random.direction(), random.number(0.1f, 0.6f), 0.7f);
    r.footprint.falloff = i % 2 ? Falloff::tent : Falloff::ward;
    r.footprint.order = 1;
    r.jet.value = random.colour(0, 2);
    r.jet.translational = random.gradient(1);
    cache.insert(r);
  }
  return cache;
}

TEST(ServingRecords, AddUpToWhatIsInterpolatedBitForBit) {
  RandomPlaces random(31);
  const RecordCache cache = crowded(random);
  int places = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 normal = random.direction();
    const Query query{random.point(room.lower, room.upper), normal, random.direction_near(normal, 0.2f)};
    Rgb sum;
    float weights = 0;
    cache.visit_serving(query, {}, [&](std::uint32_t id, float error, float weight) {
      const Record& record = cache.records()[id];
      EXPECT_EQ(error, footprint_error(record, query.position, query.normal));
      EXPECT_EQ(weight, falloff_weight(record.footprint.falloff, error));
      sum += record.extrapolate(query.position - record.position, query.facing) * weight;
      weights += weight;
    });
    const auto value = cache.interpolate(query);
    ASSERT_EQ(value.has_value(), weights > 0);
    if (!value) continue;
    EXPECT_EQ(*value, sum / weights);
    ++places;
  }
  EXPECT_GT(places, 300);
}

TEST(Standing, SaysServesWhereARecordDoes) {
  RandomPlaces random(32);
  const RecordCache cache = crowded(random);
  int count[6] = {};
  for (int i = 0; i < 30000; ++i) {
    const Record& record = cache.records()[static_cast<std::size_t>(i % 2000)];
    const Vec3 position = record.position + random.direction() * random.number(0, 0.5f), normal = random.direction();
    const Standing s = standing(record, {position, normal, normal}, {});
    EXPECT_EQ(s == Standing::serves, footprint_error(record, position, normal) < 1);
    ++count[static_cast<int>(s)];
  }
  for (const Standing s :
       {Standing::beyond_rim, Standing::facing_away, Standing::in_front, Standing::turned, Standing::serves})
    EXPECT_GT(count[static_cast<int>(s)], 100);
}

TEST(Standing, Reasons) {
  Record r = round_record({1, 1, 1}, up, 0.5f, 2);
  const auto of = [&](const Vec3& position, const Vec3& normal, OpenTest open = {}) {
    return standing(r, {position, normal, normal}, open);
  };
  EXPECT_EQ(of({1.2f, 1, 1}, up), Standing::serves);
  EXPECT_EQ(of({1.6f, 1, 1}, up), Standing::beyond_rim);
  EXPECT_EQ(of({1.2f, 1, 1}, -up), Standing::facing_away);
  EXPECT_EQ(of({1.2f, 1, 0.8f}, up), Standing::in_front);
  EXPECT_EQ(of({1.2f, 1, 1}, normalize(Vec3{1, 0, 1})), Standing::turned);
  const auto closed = [](const Site&, const Query&) { return false; };
  EXPECT_EQ(of({1.2f, 1, 1}, up, closed), Standing::serves);  // nothing near was seen: nobody asks
  for (int sector = 0; sector < Obstacles::sectors; ++sector) r.jet.distances.obstacles.meet(sector, 0.1f);
  EXPECT_EQ(of({1.2f, 1, 1}, up, closed), Standing::blocked);
}

}  // namespace
}  // namespace isophote::test
