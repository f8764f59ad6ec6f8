#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/cache/volume_cache.h"
#include "support/media.h"

namespace isophote::test {
namespace {

Scene foggy_box(const Rgb& scattering, const Rgb& absorption, float g, float scale = 1) {
  Scene scene = scenes::cornell_box(scale);
  scene.media.push_back(
      scenes::medium(scattering / scale, absorption / scale, {Vec3{-1, 0, -1} * scale, Vec3{1, 2, 1} * scale}, g));
  return scene;
}

Job foggy_job(const Stage& stage, const char* name, int size, int samples) {
  Job job = stage.job(method(name, 0.1), size, size, samples);
  job.strata = Strata::about(200);
  return job;
}

double level(const Job& job) {
  const Rendered r = render_all(job);
  return mean_luminance(r.layer("direct")) + mean_luminance(r.layer("indirect"));
}

TEST(MediaCaches, KeepTheMeanLevelInFog) {
  const Stage stage(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0));
  const double paths = level(foggy_job(stage, "path", 32, 1024));
  for (const char* name : {"jarosz2008a", "jarosz2008b", "marco2018", "cached"})
    EXPECT_NEAR(level(foggy_job(stage, name, 32, 64)) / paths, 1, 0.02) << name;
}

TEST(MediaCaches, KeepTheMeanLevelWhereMediaScatterForwards) {
  const Stage stage(foggy_box(Rgb(0.4f), Rgb(0.1f), 0.5f));
  const double paths = level(foggy_job(stage, "path", 32, 1024));
  EXPECT_NEAR(level(foggy_job(stage, "jarosz2008a", 32, 64)) / paths, 1, 0.02);
}

TEST(MediaCaches, KeepTheMeanLevelWhereRecordsCannotHoldThePhaseFunction) {
  const Stage stage(foggy_box(Rgb(0.8f), Rgb(0.1f), 0.85f));
  const double paths = level(foggy_job(stage, "path", 32, 512));
  EXPECT_NEAR(level(foggy_job(stage, "cached", 24, 64)) / paths, 1, 0.025);
}

TEST(MediaCaches, KeepTheMeanLevelOfGlowingFog) {
  Scene scene = foggy_box(Rgb(0.4f), Rgb(0.2f), 0.3f);
  scene.media[0].emission = {2, 1, 0.5f};
  scene.media[0].bounds = Box{{-0.9f, 0.1f, -0.9f}, {0.9f, 0.8f, 0.9f}};
  const Stage stage(std::move(scene));
  const double paths = level(foggy_job(stage, "path", 32, 512));
  EXPECT_NEAR(level(foggy_job(stage, "cached", 32, 64)) / paths, 1, 0.02);
}

TEST(MediaCaches, KeepTheMeanLevelAmongManyLightsOfAllKinds) {
  Scene scene = foggy_box(Rgb(0.4f), Rgb(0.1f), 0.4f);
  for (int i = 0; i < 6; ++i) {
    PunctualLight light;
    light.position = {0.28f * static_cast<float>(i) - 0.7f, 0.5f + 0.2f * static_cast<float>(i), 0.3f};
    light.intensity = {1, 1.5f, 0.5f};
    if (i % 3 == 1) light.kind = PunctualLight::Kind::spot, light.direction = {0, -1, 0}, light.outer_cone = 0.6f;
    scene.lights.push_back(light);
  }
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  sun.direction = normalize(Vec3{0.3f, -0.5f, -1}), sun.intensity = Rgb(2);
  scene.lights.push_back(sun);
  const Stage stage(std::move(scene));
  const double paths = level(foggy_job(stage, "path", 32, 512));
  EXPECT_NEAR(level(foggy_job(stage, "cached", 32, 64)) / paths, 1, 0.025);
}

TEST(MediaCaches, KeepTheMeanLevelOfDenseSmoke) {
  // Twelve free paths across, lit from above, in thin air.
  Scene scene = foggy_box(Rgb(0.02f), Rgb(0.01f), 0);
  scene.media.push_back(scenes::medium({14.5f, 14, 13}, Rgb(0.7f), {{-0.4f, 0.5f, -0.4f}, {0.4f, 1.3f, 0.4f}}));
  const Stage stage(std::move(scene));
  const auto indirect = [](const Job& job) { return mean_luminance(render_all(job).layer("indirect")); };
  const double paths = indirect(foggy_job(stage, "path", 32, 512));
  for (const char* name : {"jarosz2008a", "cached"})
    EXPECT_NEAR(indirect(foggy_job(stage, name, 32, 16)) / paths, 1, 0.04) << name;
}

TEST(MediaCaches, KeepTheMeanLevelOfAThinCloudAndOfSootInAir) {
  // Media that fill shells of a gather in part, and such of unlike albedo.
  for (const bool soot : {false, true}) {
    Scene scene = scenes::cornell_box();
    if (soot) scene.media.push_back(scenes::medium(Rgb(0.3f), {}, {{-1, 0, -1}, {1, 2, 1}}));
    const Rgb scattering = soot ? Rgb(1.0f) : Rgb(1.5f), absorption = soot ? Rgb(4.0f) : Rgb(0.1f);
    scene.media.push_back(scenes::medium(scattering, absorption, {{-0.5f, 0.6f, -0.5f}, {0.5f, 0.9f, 0.5f}}));
    const Stage stage(std::move(scene));
    const auto indirect = [](const Job& job) { return mean_luminance(render_all(job).layer("indirect")); };
    const double paths = indirect(foggy_job(stage, "path", 32, 1024));
    EXPECT_NEAR(indirect(foggy_job(stage, "cached", 32, 16)) / paths, 1, 0.025) << soot;
  }
}

TEST(MediaCaches, SurfacesAreCachedRightWhereMediaAreLeftToPaths) {
  const Stage stage(foggy_box(Rgb(0.4f), Rgb(0.1f), 0));
  const double paths = level(foggy_job(stage, "path", 32, 1024));
  Job job = foggy_job(stage, "bounded", 32, 512);
  EXPECT_NEAR(level(job) / paths, 1, 0.02);
}

TEST(MediaCaches, WhatMediaHideOfTheSkyIsNotTransparent) {
  const Stage stage(scenes::cloud_under_a_white_sky(scenes::medium(Rgb(0.5f), Rgb(0.2f), {{-1, -1, -1}, {1, 1, 1}})));
  const auto opacity = [&](const char* name) {
    const ExrFile file = render_all(foggy_job(stage, name, 16, 64)).exr();
    double sum = 0;
    for (const float alpha : file.find("A")->values) sum += static_cast<double>(alpha);
    return sum / 256;
  };
  const double paths = opacity("path");
  EXPECT_GT(paths, 0.3);
  EXPECT_NEAR(opacity("jarosz2008a") / paths, 1, 0.1);
}

TEST(MediaCaches, EachCombinationGivesAPicture) {
  // Neither negative nor beyond numbers, in fog, smoke and glow.
  Scene scene = foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f);
  scene.media.push_back(scenes::medium(Rgb(20), {5, 0, 1}, {{-0.5f, 0.2f, -0.5f}, {0.2f, 1, 0.2f}}, -0.5f));
  scene.media.push_back(scenes::medium({}, Rgb(0.1f), {{0.3f, 0.2f, -0.5f}, {0.6f, 1, 0.2f}}));
  scene.media.back().emission = {3, 2, 1};
  const Stage stage(std::move(scene));
  int pictures = 0;
  for (const VolumeEstimator& e : volume_estimators())
    for (const VolumeMetric& m : volume_metrics()) {
      if (e.order < m.needs || (m.needs_sums && !e.sums)) continue;
      SCOPED_TRACE(std::string(e.name) + " " + std::string(m.name));
      Job job = foggy_job(stage, "cached", 16, 1);
      job.method.volume = {InScattering::cache, &e, &m, {}, pictures % 2 == 0};
      job.method.volume.settings.a = threshold(m, 0.3);
      job.method.volume.settings.bounds.gradient = m.by_gradient && e.order > 0;
      check_combination(job.method);
      const Rendered r = render_all(job);
      for (const Rgb& p : r.layer("").pixels) ASSERT_TRUE(is_finite(p) && std::min({p.r, p.g, p.b}) >= 0);
      EXPECT_GT(r.cache.volumes()->media.records().size(), 0u);
      ++pictures;
    }
  EXPECT_GE(pictures, 9);
}

TEST(MediaCaches, ThreadsDoNotChangeThem) {
  const Stage stage(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f));
  for (const char* name : {"jarosz2008a", "jarosz2008b", "marco2018", "cached"}) {
    Job job = foggy_job(stage, name, 24, 2);
    job.parallel = thread_for(1);
    const Rendered serial = render_all(job);
    EXPECT_GT(serial.cache.volumes()->media.records().size(), 0u);
    for (const int threads : {2, 8}) {
      job.parallel = thread_for(threads);
      const Rendered other = render_all(job);
      EXPECT_TRUE(exr_bytes(other.exr()) == exr_bytes(serial.exr())) << name << " on " << threads;
      EXPECT_EQ(other.cache.volumes()->media.records().size(), serial.cache.volumes()->media.records().size());
    }
  }
}

TEST(MediaCaches, RecordsReadBackGiveTheSamePicture) {
  const Stage stage(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f));
  for (const char* name : {"jarosz2008a", "marco2018"}) {
    const Job job = foggy_job(stage, name, 24, 2);
    Rendered first = render_all(job);
    const auto all = [](const auto& cache) { return std::vector(cache.records().begin(), cache.records().end()); };
    const std::string path = testing_files::temporary("records");
    RecordFile saved;
    saved.records = all(first.cache);
    saved.volumes = {all(first.cache.volumes()->surfaces), all(first.cache.volumes()->media)};
    write_records(path, saved);
    const RecordFile file = read_records(path);
    Rendered again{Film(24, 24), empty_cache(job), empty_cache(job), {}, {}};
    for (const Record& record : file.records) again.cache.insert(record);
    for (const VolumePart part : {VolumePart::surfaces, VolumePart::media})
      for (const VolumeRecord& record : file.volumes[static_cast<std::size_t>(part)])
        again.cache.volumes()->of(part).insert(record);
    again.cache.reindex();
    for (const VolumePart part : {VolumePart::surfaces, VolumePart::media}) again.cache.volumes()->of(part).reindex();
    render(job, &again.cache, again.film);
    Film same(24, 24);
    render(job, &first.cache, same);
    EXPECT_GT(file.volumes[0].size() + file.volumes[1].size(), 100u);
    EXPECT_TRUE(exr_bytes(again.exr()) == exr_bytes(same.exr())) << name;
  }
}

TEST(MediaCaches, PowersOfTwoOfTheSizeDoNotChangeThem) {
  const Stage base(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f)),
      large(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f, 0x1p10f));
  for (const char* name : {"path", "jarosz2008a", "jarosz2008b", "cached"}) {
    const Rendered a = render_all(foggy_job(base, name, 24, 2)), b = render_all(foggy_job(large, name, 24, 2));
    EXPECT_EQ(a.layer("indirect").pixels, b.layer("indirect").pixels) << name;
    EXPECT_EQ(a.layer("direct").pixels, b.layer("direct").pixels) << name;
  }
}

TEST(MediaCaches, NothingLeaksIntoAClosedBox) {
  // The camera stands in a closed black-lit box that hangs in bright fog.
  Scene scene = foggy_box(Rgb(0.4f), Rgb(0.1f), 0);
  scene.meshes.push_back(scenes::box({-0.4f, 1.25f, -0.4f}, {0.4f, 1.7f, 0.4f}, true, scene.meshes[0].material));
  scene.cameras[0] = Camera::look_at({0, 1.5f, 0.35f}, {0, 1.5f, 0}, 1.2f);
  scene.cameras.push_back(Camera::look_at({0, 1, 4}, {0, 1, 0}, 0.68f));
  const Stage stage(std::move(scene));
  Job job = foggy_job(stage, "jarosz2008a", 24, 2);
  Rendered outside{Film(24, 24), empty_cache(job), empty_cache(job), {}, {}};
  job.camera = stage.scene().cameras[1];
  build_in_rounds(job, outside.cache);
  job.camera = stage.scene().cameras[0];
  render(job, &outside.cache, outside.film);
  for (const Rgb& pixel : outside.layer("indirect").pixels) EXPECT_TRUE(is_black(pixel));
}

}  // namespace
}  // namespace isophote::test
