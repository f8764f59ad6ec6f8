#include "isophote/integrate/explain.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/core/frame.h"
#include "isophote/integrate/explain_picture.h"
#include "isophote/integrate/pilot.h"
#include "isophote/integrate/record_maps.h"
#include "isophote/integrate/shade.h"
#include "support/records.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

void expect_near(const Rgb& a, const Rgb& b, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance * std::abs(b[c]) + 1e-12f);
}

Pilot pilot_of(const Job& job) {
  RayCounts counts;
  RecordCache cache = empty_cache(job);
  return survey(job, cache, random_places(job, counts), counts).pilot;
}

// Shares add up to 1, extrapolated values to what is interpolated, and predictions to the map's.
TEST(Explain, SharesMakeUpTheValue) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"ward1992", "cached", "schwarzhaupt2012", "swept"}) {
    Job job = stage.job(method(name, 0.05), 48, 48, 2);
    job.strata = Strata::about(100);
    job.pilot = pilot_of(job);
    const Rendered rendered = render_all(job);
    RayCounts rays;
    const RecordMaps maps = record_maps(job, rendered.shown, rays);
    const RgbImage direct = rendered.layer("direct"), indirect = rendered.layer("indirect");
    int explained = 0;
    for (int i = 0; i < 48 * 48; i += 37) {
      const int x = i % 48, y = i / 48;
      const Explanation e = explain(job, rendered.shown, x, y);
      EXPECT_EQ(e.mean.direct, direct.at(x, y)) << name;
      EXPECT_EQ(e.mean.indirect, indirect.at(x, y)) << name;
      EXPECT_EQ(e.irradiance.has_value(), !e.serving.empty());
      if (!e.irradiance) continue;
      ++explained;
      EXPECT_EQ(*e.irradiance, *rendered.shown.interpolate(query_at(*e.seen.point)));
      float share = 0, error = 0, last = 1;
      Rgb sum;
      for (const ServingRecord& s : e.serving) {
        share += s.share, sum += s.extrapolated * s.share, error += s.predicted_error * s.share;
        EXPECT_LE(s.share, last);
        last = s.share;
        EXPECT_LT(s.footprint_error, 1);
      }
      EXPECT_NEAR(share, 1, 1e-5f);
      expect_near(sum, *e.irradiance, 1e-4f);
      EXPECT_NEAR(error, e.predicted_error, 1e-5f);
      EXPECT_NEAR(e.predicted_error, maps.error[static_cast<std::size_t>(i)], 1e-5f);
      EXPECT_GT(maps.density[static_cast<std::size_t>(i)], 0);
    }
    EXPECT_GT(explained, 40) << name;
  }
}

TEST(Explain, SaysWhatChangedARadius) {
  const Stage stage("cornell-box.glb");
  const auto all_reaches = [&](const Method& how) {
    Job job = stage.job(how, 32, 32, 1);
    job.strata = Strata::about(100);
    job.pilot = pilot_of(job);
    const RecordCache cache = render_all(job).cache;
    std::vector<std::pair<Reach, Record>> reaches;
    for (int i = 0; i < 32 * 32; i += 5)
      for (const ServingRecord& s : explain(job, cache, i % 32, i / 32).serving)
        reaches.emplace_back(s.reach, cache.records()[s.id]);
    return reaches;
  };
  for (const auto& [reach, record] : all_reaches(method("ward1992"))) {
    EXPECT_NEAR(reach.axes.longer, reach.natural, 1e-3f * reach.natural);
    EXPECT_FALSE(reach.gradient || reach.neighbours || reach.raised || reach.lowered);
    EXPECT_EQ(reach.gradient_kept, 1);
  }
  int gradient = 0, neighbours = 0, raised = 0, lowered = 0;
  Method tight = method("bounded");
  tight.settings.bounds.max_pixels = 1.6f;
  for (const auto& [reach, record] : all_reaches(tight)) {
    gradient += reach.gradient, neighbours += reach.neighbours, raised += reach.raised, lowered += reach.lowered;
    EXPECT_EQ(reach.raised, record.footprint.radius == record.footprint.smallest && reach.raised);
    EXPECT_EQ(reach.lowered, record.footprint.radius == record.footprint.largest && reach.lowered);
    if (reach.raised) {
      EXPECT_LT(reach.gradient_kept, 1);
    } else if (!reach.gradient && !reach.neighbours && !reach.lowered) {
      EXPECT_NEAR(reach.axes.longer, reach.natural, 1e-3f * reach.natural);
    }
  }
  EXPECT_GT(gradient, 0);
  EXPECT_GT(neighbours, 0);
  EXPECT_GT(raised, 0);
  EXPECT_GT(lowered, 0);
  // Hessian radii are asked for again with the same pilot, which gives the same.
  int unchanged = 0;
  for (const auto& [reach, record] : all_reaches(method("schwarzhaupt2012", 0.2))) {
    EXPECT_FALSE(reach.gradient || reach.neighbours || reach.lowered);
    if (reach.raised) continue;
    EXPECT_NEAR(reach.axes.longer, reach.natural, 1e-3f * reach.natural);
    ++unchanged;
  }
  EXPECT_GT(unchanged, 100);
}

// In the dark room beside a thin wall: the bright side's records are stopped there, and where a ray was cast and found
// the way to be free, it says so.
TEST(Explain, TellsWhatTheLeakTestFound) {
  const Stage stage("thin-wall.glb");
  RecordCache cache = empty_cache(stage.job(method("cached"), 64, 48, 1, "bright"));
  for (const char* camera : {"bright", "dark"}) {
    Job job = stage.job(method("cached"), 64, 48, 1, camera);
    job.method.adaptive = false;
    job.strata = Strata::about(200);
    build_in_rounds(job, cache);
  }
  Job job = stage.job(method("cached"), 64, 48, 1, "dark");
  job.pilot = pilot_of(job);
  int blocked = 0, free = 0;
  for (int i = 0; i < 64 * 48; i += 5) {
    const Explanation e = explain(job, cache, i % 64, i / 64);
    for (const NearMiss& miss : e.near_misses) blocked += miss.why == Standing::blocked;
    for (const ServingRecord& s : e.serving) free += s.tested;
  }
  EXPECT_GT(blocked, 0);
  EXPECT_GT(free, 0);
}

TEST(Explain, RecordsThatNearlyServe) {
  const Stage stage(scenes::cornell_box());
  Job job = stage.job(method("uniform"), 64, 64, 1);
  RecordCache cache = empty_cache(job);
  const Explanation bare = explain(job, cache, 32, 32);
  EXPECT_TRUE(bare.reads_cache);
  EXPECT_FALSE(bare.irradiance);
  const Vec3 p = bare.seen.point->position, n = bare.normal, aside = Frame(n).u;
  cache.insert(round_record(p + aside * 0.12f, n, 0.1f));
  cache.insert(round_record(p + aside * 0.05f, -n, 0.1f));
  cache.insert(round_record(p + aside * 0.01f, n, 0.1f));
  cache.insert(round_record(p + aside * 0.16f, n, 0.1f));
  cache.insert(round_record(p + n * 0.03f, n, 0.1f));
  const Explanation e = explain(job, cache, 32, 32);
  ASSERT_EQ(e.serving.size(), 1u);
  EXPECT_EQ(e.serving[0].id, 2u);
  EXPECT_EQ(e.serving[0].share, 1);
  ASSERT_EQ(e.near_misses.size(), 3u) << "that at 1.6 radii is none";
  EXPECT_EQ(e.near_misses[0].why, Standing::in_front);
  EXPECT_EQ(e.near_misses[1].why, Standing::facing_away);
  EXPECT_EQ(e.near_misses[2].why, Standing::beyond_rim);
  EXPECT_NEAR(e.near_misses[2].rim, 1.2f, 1e-4f);
}

TEST(Explain, TheSkyReadsNothing) {
  const Stage stage("plate.glb");
  const Job job = stage.job(method("cached"), 32, 32, 1);
  const Explanation e = explain(job, empty_cache(job), 0, 0);
  EXPECT_FALSE(e.reads_cache);
  EXPECT_EQ(e.seen.first_distance, infinity);
}

/// A place on the plane z = 0 as seen from an eye, by the ray through (u, v), in pixels about a middle.
struct Eye {
  Vec3 position, forward, right, up;
  float pixel_angle = 0.002f;

  Sight sight(float u, float v) const {
    const Vec3 d = normalize(forward + (right * u + up * v) * pixel_angle);
    const float distance = -position.z / d.z;
    Sight sight{};
    sight.place.position = position + d * distance;
    sight.place.normal = sight.place.geometric_normal = {0, 0, 1};
    sight.direction = d;
    sight.pixel = distance * pixel_angle;
    return sight;
  }
};

// The distance to a rim, told from the form's slope at one place, is what stepping over the screen finds, for an
// elongated footprint seen at a slant.
TEST(FootprintOnScreen, DistancesAreInPixels) {
  const Vec3 eye{0, -3, 0.8f}, forward = normalize(Vec3{0, 0, 0} - eye), right{1, 0, 0};
  const Eye from{eye, forward, right, cross(right, forward)};
  Record record = round_record({0.02f, 0.01f, 0}, {0, 0, 1}, 0.3f);
  const Vec3 along = normalize(Vec3{1, 2, 0}), across{-along.y, along.x, 0};
  record.footprint.shape =
      Sym3::outer(along, 1 / 0.09f) + Sym3::outer(across, 1 / 0.01f) + Sym3::outer({0, 0, 1}, 1 / 0.01f);
  int near_rim = 0;
  for (float u = -60; u <= 60; u += 1.5f)
    for (float v = -20; v <= 20; v += 0.5f) {
      const float inside = on_screen(record, from.sight(u, v)).inside_rim;
      if (std::abs(inside) > 2) continue;
      ++near_rim;
      // The nearest place of the rim, by search over directions.
      float nearest = infinity;
      for (int i = 0; i < 90; ++i) {
        const float c = std::cos(0.06981317f * static_cast<float>(i)),
                    s = std::sin(0.06981317f * static_cast<float>(i));
        for (float r = 0; r < std::min(4.0f, nearest); r += 0.02f)
          if ((on_screen(record, from.sight(u + r * c, v + r * s)).inside_rim < 0) != (inside < 0)) nearest = r;
      }
      // A line of no width is exact; the ends of the ellipse, seen thin, bend within these few pixels.
      EXPECT_NEAR(std::abs(inside), nearest, 0.05f + 0.2f * nearest) << u << " " << v;
    }
  EXPECT_GT(near_rim, 300);
  const Vec3 centre = record.position - eye;
  const float scale = 1 / (dot(centre, forward) * from.pixel_angle);
  const float u = dot(centre, from.right) * scale, v = dot(centre, from.up) * scale;
  EXPECT_NEAR(on_screen(record, from.sight(u + 3, v + 4)).from_centre, 5, 0.2f);
}

// Records as dense as a lattice's cell says, on the whole, and their footprints' sizes do not matter.
TEST(RecordDensity, IntegratesToTheNumberOfRecords) {
  RandomPlaces random(9);
  RecordCache cache(Box{{0, 0, 0}, {10, 10, 1}});
  for (int i = 0; i < 40; ++i) {
    Record r = round_record(random.point({3, 3, 0}, {7, 7, 0}), {0, 0, 1}, random.number(0.3f, 2), 1);
    r.footprint.shape.xx *= random.number(1, 4);
    cache.insert(r);
  }
  double sum = 0;
  for (float x = 0.01f; x < 10; x += 0.02f)
    for (float y = 0.01f; y < 10; y += 0.02f)
      sum += 0.02 * 0.02 * record_density(cache, {{x, y, 0}, {0, 0, 1}, {0, 0, 1}}, {});
  EXPECT_NEAR(sum, 40, 0.1);
}

TEST(ExplanationPicture, HasTheCrossAndTheRims) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("swept", 0.05), 96, 64, 1);
  job.strata = Strata::about(100);
  const RecordCache cache = render_all(job).cache;
  const Explanation e = explain(job, cache, 40, 20);
  ASSERT_FALSE(e.serving.empty());
  const auto [picture, window] = explanation_picture(job, cache, e, 40, 20);
  EXPECT_GT(window.zoom, 1);
  const float u = (40.5f - window.x) * window.zoom + 48, v = (20.5f - window.y) * window.zoom + 32;
  EXPECT_EQ(picture.at(static_cast<int>(u), static_cast<int>(v)), Rgb(1));
  int red = 0;
  for (const Rgb& c : picture.pixels) red += c == legend_colour(0).colour;
  EXPECT_GT(red, 20);
}

}  // namespace
}  // namespace isophote::test
