#include "isophote/cache/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/records.h"

// Fields whose values and derivatives are known, on the plane z = 0.
namespace isophote::test {
namespace {

constexpr Box room{{-2, -2, -1}, {2, 2, 1}};
constexpr Vec3 up{0, 0, 1};
constexpr float radius = 0.3f;

/// value = level + (slope, 0) . p + bend x^2 / 2, of luminance and all channels alike
struct Field {
  float level = 1, slope = 0, bend = 0;

  Record at(const Vec3& p) const {
    Record r = round_record(p, up, radius);
    r.footprint.order = 2;
    r.jet.value = Rgb(level + slope * p.x + bend * p.x * p.x / 2);
    r.jet.translational = {Rgb(slope + bend * p.x), Rgb(), Rgb()};
    r.jet.hessian = {bend, 0, 0, 0, 0, 0};
    r.jet.rays = 400, r.jet.gradient_error = 0;
    return r;
  }
};

/// Normal deviates with the standard errors that records then state.
struct Noise {
  float value = 0, gradient = 0;
};

RecordCache cache_of(const Field& field, const Noise& noise = {}, int count = 400, std::uint32_t seed = 1) {
  RandomPlaces random(seed);
  const auto deviate = [&] {
    return std::sqrt(-2 * std::log(random.number(1e-6f, 1))) * std::cos(2 * M_PIf * random.number(0, 1));
  };
  RecordCache cache(room);
  for (int i = 0; i < count; ++i) {
    Record r = field.at(random.point({-1, -1, 0}, {1, 1, 0}));
    r.jet.value += Rgb(noise.value * deviate());
    r.jet.translational.x += Rgb(noise.gradient * deviate());
    r.jet.translational.y += Rgb(noise.gradient * deviate());
    r.jet.standard_error = noise.value, r.jet.gradient_error = noise.gradient;
    cache.insert(r);
  }
  return cache;
}

/// Calls visit(before, after) for records away from the rim of the field.
void for_each_fitted(const RecordCache& cache, const std::function<void(const Record&, const Record&)>& visit,
                     OpenTest open = {}, double distrust = 4) {
  const Regression regression(cache);
  for (std::uint32_t id = 0; id < cache.records().size(); ++id) {
    const Record& before = cache.records()[id];
    if (std::max(std::abs(before.position.x), std::abs(before.position.y)) < 0.7f)
      visit(before, regression.fitted(id, distrust, open));
  }
}

TEST(Regression, LeavesAFieldWithoutNoiseAsItIs) {
  for (const Field& field : {Field{1, 0, 0}, Field{1, 0.3f, 0}, Field{2, 0.3f, 0.5f}})
    for_each_fitted(cache_of(field), [&](const Record& before, const Record& after) {
      EXPECT_NEAR(after.jet.value.g, before.jet.value.g, 1e-3 * before.jet.value.g);
      EXPECT_NEAR(after.jet.translational.x.g, before.jet.translational.x.g, 2e-3);
      EXPECT_NEAR(after.jet.translational.y.g, 0, 2e-3);
    });
}

/// What a parabola leaves out, here of a sine, is of the third order: a record that states no noise keeps its value.
TEST(Regression, DoesNotSmoothWhatIsNoNoise) {
  RecordCache cache(room);
  RandomPlaces random(3);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = random.point({-1, -1, 0}, {1, 1, 0});
    const float a = 6 * p.x;
    Record r = round_record(p, up, radius);
    r.jet.value = Rgb(2 + std::sin(a));
    r.jet.translational.x = Rgb(6 * std::cos(a));
    r.jet.hessian = {-36 * std::sin(a), 0, 0, 0, 0, 0};
    r.jet.rays = 400, r.jet.gradient_error = 0;
    cache.insert(r);
  }
  for_each_fitted(cache, [](const Record& before, const Record& after) {
    EXPECT_NEAR(after.jet.value.g, before.jet.value.g, 1e-3);
  });
}

TEST(Regression, LessensNoiseToWhatItStates) {
  const Field field{1, 0.2f, 0.1f};
  const Noise noise{0.05f, 0.2f};
  double before_squares = 0, after_squares = 0, stated = 0, mean = 0, count = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed)
    for_each_fitted(cache_of(field, noise, 400, seed), [&](const Record& before, const Record& after) {
      const double truth = field.at(before.position).jet.value.g;
      before_squares += std::pow(before.jet.value.g - truth, 2),
          after_squares += std::pow(after.jet.value.g - truth, 2);
      stated += std::pow(after.jet.standard_error, 2), mean += after.jet.value.g - truth, ++count;
    });
  const double gain = std::sqrt(before_squares / after_squares), ratio = std::sqrt(stated / after_squares);
  std::printf("noise %.1f times less, stated %.2f times what it is\n", gain, ratio);
  EXPECT_GT(gain, 2.5);
  EXPECT_GT(ratio, 0.9) << "it counts what a parabola may leave out, too";
  EXPECT_LT(ratio, 1.5);
  EXPECT_NEAR(mean / count, 0, 0.002);
}

TEST(Regression, MovesNoRecordByMoreThanThreeOfItsErrors) {
  RecordCache cache = cache_of({}, {0.01f, 0.1f});
  Record outlier = Field{3}.at({0, 0, 0});
  outlier.jet.standard_error = 0.01f;
  const std::uint32_t id = cache.insert(outlier);
  const Record after = Regression(cache).fitted(id, 4, {});
  EXPECT_LT(after.jet.value.g, 3);
  EXPECT_GT(after.jet.value.g, 3 - 3 * 3 * 0.011f) << "three errors, relative to its value";
}

/// Two levels that meet at x = 0, where something parts them, as the records and the host's test know.
TEST(Regression, DoesNotReachBehindAnything) {
  RandomPlaces random(5);
  RecordCache cache(room);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = random.point({-1, -1, 0}, {1, 1, 0});
    Record r = Field{p.x < 0 ? 1.0f : 2.0f}.at(p);
    r.jet.standard_error = 0.2f, r.jet.gradient_error = 1;
    for (int s = 0; s < Obstacles::sectors; ++s) r.jet.distances.obstacles.meet(s, std::abs(p.x));
    cache.insert(r);
  }
  const auto same_side = [](const Site& a, const Query& b) { return (a.position.x < 0) == (b.position.x < 0); };
  const auto largest_change = [&](OpenTest open) {
    double largest = 0;
    for_each_fitted(
        cache,
        [&](const Record& before, const Record& after) {
          largest = std::max(largest, std::abs(double{after.jet.value.g} - before.jet.value.g));
        },
        open);
    return largest;
  };
  EXPECT_LT(largest_change(OpenTest(same_side)), 1e-6);
  EXPECT_GT(largest_change({}), 0.2);
}

/// Neither a wall that stands on the floor nor a shelf close above has a say in the floor's light.
TEST(Regression, KeepsToOneSurface) {
  RandomPlaces random(6);
  RecordCache cache = cache_of({}, {0.1f, 0.1f});
  const std::size_t floor = cache.records().size();
  std::vector<Record> alone;
  for_each_fitted(cache, [&](const Record&, const Record& after) { alone.push_back(after); });
  for (int i = 0; i < 400; ++i) {
    Record wall = Field{50}.at(random.point({0, -1, 0}, {0, 1, 1})),
           shelf = Field{50}.at(random.point({-1, -1, 0.2f}, {1, 1, 0.2f}));
    wall.normal = {1, 0, 0};
    // Whatever lies above a place at more than a seventh of the way there is on another surface.
    shelf.footprint.radius = 0.15f;
    cache.insert(wall), cache.insert(shelf);
  }
  const Regression regression(cache);
  std::size_t i = 0;
  for (std::uint32_t id = 0; id < floor; ++id) {
    const Vec3& p = cache.records()[id].position;
    if (std::max(std::abs(p.x), std::abs(p.y)) >= 0.7f) continue;
    EXPECT_EQ(regression.fitted(id, 4, {}).jet.value, alone[i++].jet.value);
  }
}

/// The estimate of the error falls with what smooths, on a flat field, and grows with it where there is no noise.
TEST(Regression, RisksTellNoiseFromShape) {
  const auto risk = [](const RecordCache& cache) {
    const Regression regression(cache);
    Regression::Risks sum{};
    for (std::uint32_t id = 0; id < cache.records().size(); ++id) {
      const Regression::Risks risks = regression.risks(id, {});
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += risks[i] / static_cast<double>(cache.records().size());
    }
    return sum;
  };
  const Regression::Risks flat = risk(cache_of({1, 0, 0.5f}, {0.05f, 0.2f}));
  EXPECT_LT(flat.front(), flat.back());
  EXPECT_GT(flat.front(), 0);
  EXPECT_LT(flat.front(), 0.05 * 0.05 / 2);
  RecordCache stepped(room);
  RandomPlaces random(8);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = random.point({-1, -1, 0}, {1, 1, 0});
    Record r = Field{std::sin(20 * p.x) > 0 ? 1.0f : 1.5f, 0, 1}.at(p);
    r.jet.standard_error = 0.01f, r.jet.gradient_error = 0.2f;
    stepped.insert(r);
  }
  const Regression::Risks steps = risk(stepped);
  EXPECT_GT(steps.front(), steps.back());
}

TEST(Regression, LeavesRecordsAloneThatItCannotFit) {
  RandomPlaces random(9);
  RecordCache few(room), dark = cache_of({0, 0, 0}), wild(room);
  few.insert(Field{}.at({0, 0, 0})), few.insert(Field{2}.at({0.1f, 0, 0}));
  EXPECT_EQ(Regression(few).fitted(0, 4, {}).jet.value, Rgb(1));
  EXPECT_EQ(Regression(dark).fitted(0, 4, {}).jet.value, Rgb());
  for (int i = 0; i < 50; ++i) {
    Record r = Field{1e30f, 0, 0}.at(random.point({-0.1f, -0.1f, 0}, {0.1f, 0.1f, 0}));
    r.jet.translational.x = Rgb(1e30f), r.jet.hessian.xx = 1e30f;
    r.jet.standard_error = i % 2 ? 1e30f : 0, r.jet.gradient_error = i % 3 ? infinity : 0;
    r.jet.rays = i % 5 ? 400 : 0;
    if (i > 25) r.footprint = Footprint::disk(1e-10f, 1), r.position.x = 1e-11f * static_cast<float>(i);
    wild.insert(r);
  }
  const Regression regression(wild);
  for (std::uint32_t id = 0; id < 50; ++id) {
    const Record r = regression.fitted(id, 4, {});
    EXPECT_TRUE(is_finite(r.jet.value) && is_finite(r.jet.translational.x) && is_finite(r.jet.translational.z));
  }
}

}  // namespace
}  // namespace isophote::test
