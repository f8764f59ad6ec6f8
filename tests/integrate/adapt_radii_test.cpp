// Records of incident radiance that shrink where they differ from each other.
#include "isophote/integrate/adapt_radii.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

/// A metal floor of 2 by 2 seen from above.
Scene floor_alone() {
  Scene scene;
  scene.meshes.push_back(
      scenes::quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, scenes::add(scene, scenes::metal(Rgb(0.9f), 0.7f))));
  scene.cameras = {Camera::look_at({0, 3, 0.1f}, {0, 0, 0}, 0.6f)};
  return scene;
}

/// A record of the floor at (x, z) that saw one radiance everywhere.
RadianceRecord record_at(float x, float z, float radiance, float radius) {
  RadianceRecord record;
  record.position = {x, 0, z}, record.normal = {0, 1, 0};
  constexpr int bands = 10;
  record.jet.value.assign(harmonics_count(bands), Rgb{});
  record.jet.value[0] = Rgb(radiance * std::sqrt(2 * pi));  // of the hemispherical function 1 / sqrt(2 pi)
  record.footprint = Footprint::disk(radius, 1);
  return record;
}

struct Adapted {
  std::vector<float> radii;

  Adapted(std::initializer_list<RadianceRecord> records, float contrast, int threads = 2) {
    const Stage stage(floor_alone());
    Job job = stage.job(method("krivanek2006"), 64, 64, 1);
    job.method.glossy.contrast = contrast;
    job.parallel = thread_for(threads);
    RadianceCache cache(stage.scene().bounds(), Basis::hemispherical);
    for (const RadianceRecord& r : records) cache.insert(r);
    RayCounts counts;
    adapt_radii(job, cache, 1, 0, counts);
    for (const RadianceRecord& r : cache.records()) radii.push_back(r.footprint.radius);
  }
};

TEST(AdaptRadii, RecordsThatAgreeStayAsTheyAre) {
  EXPECT_EQ(Adapted({record_at(-0.2f, 0, 1, 0.6f), record_at(0.3f, 0, 1.05f, 0.6f)}, 0.1f).radii,
            (std::vector{0.6f, 0.6f}));
}

// Of two equally large ones each keeps its half of the way between them.
TEST(AdaptRadii, RecordsThatDifferShrinkToWhereTheOtherWeighsMore) {
  const auto radii = Adapted({record_at(-0.2f, 0, 1, 0.45f), record_at(0.3f, 0, 1.2f, 0.45f)}, 0.1f).radii;
  constexpr float pixel = 0.04f;
  EXPECT_NEAR(radii[0], 0.25f, pixel);
  EXPECT_NEAR(radii[1], 0.25f, pixel);
}

// Nor to less than half at once, however near the one that weighs more is.
TEST(AdaptRadii, NotToLessThanTheBound) {
  const RadianceRecord small = record_at(-0.1f, 0, 2, 0.3f);
  RadianceRecord large = record_at(0, 0, 1, 0.8f);
  EXPECT_EQ(Adapted({small, large}, 0.1f).radii, (std::vector{0.15f, 0.4f}));
  large.footprint.smallest = 0.7f;
  EXPECT_EQ(Adapted({small, large}, 0.1f).radii, (std::vector{0.15f, 0.7f}));
}

TEST(AdaptRadii, ThreadsDoNotChangeIt) {
  const auto radii = [](int threads) {
    return Adapted({record_at(-0.2f, 0.1f, 1, 0.6f), record_at(0.3f, 0, 1.3f, 0.5f), record_at(0, -0.4f, 0.8f, 0.7f)},
                   0.1f, threads)
        .radii;
  };
  EXPECT_EQ(radii(1), radii(8));
}

// In a whole build, what shrinks is covered anew.
TEST(AdaptRadii, BuildsCoverThePicture) {
  Scene scene = scenes::cornell_box();
  scene.meshes[0].material = scenes::add(scene, scenes::metal(Rgb(0.9f), 0.7f));
  const Stage stage(std::move(scene));
  const auto built = [&](float contrast) {
    Job job = stage.job(method("krivanek2006", 0.1), 48, 48, 1);
    job.strata = Strata::about(200);
    job.method.glossy.contrast = contrast;
    return render_all(job);
  };
  const Rendered adapted = built(0.1f), not_adapted = built(0);
  EXPECT_LE(adapted.final.uncovered, not_adapted.final.uncovered);
  EXPECT_GT(adapted.cache.radiance()->records().size(), not_adapted.cache.radiance()->records().size());
}

}  // namespace
}  // namespace isophote::test
