#include <gtest/gtest.h>

#include "integrate/back_wall_record.h"
#include "integrate/stage.h"
#include "isophote/core/error.h"
#include "isophote/image/false_colour.h"
#include "isophote/integrate/record_picture.h"
#include "isophote/integrate/scene_hash.h"
#include "isophote/scene/density_grid.h"
#include "support/media.h"
#include "support/scenes.h"

// Records kept on file, told to belong to a scene, and shown.
namespace isophote::test {
namespace {

RecordCache loaded(const Job& job, const std::string& path) {
  RecordCache cache = empty_cache(job);
  for (const Record& record : read_records(path).records) cache.insert(record);
  return cache;
}

TEST(RecordFile, ASavedCacheGivesTheSamePictureAndTakesNoMoreRecords) {
  const Stage stage("cornell-box.glb");
  Job job = stage.job(method("cached", 0.05), 64, 64, 4);
  job.strata = Strata::about(100);
  const Rendered first = render_all(job);
  const std::string path = testing_files::temporary("cache");
  const auto records = first.cache.records();
  write_records(path, {scene_hash(stage.scene()), "", {}, 1, {records.begin(), records.end()}});

  const RecordCache cache = loaded(job, path);
  EXPECT_TRUE(record_bytes(cache) == record_bytes(first.cache));
  Film film(job.width, job.height);
  RayCounts counts;
  const RecordCache shown = regressed(job, cache, counts);
  const RenderReport report = render(job, &shown, film);
  EXPECT_EQ(report.uncovered, first.final.uncovered);
  // The index was filled in another order of insertions and shrinkings: sums may round differently, nothing else.
  const RgbImage a = film.irradiance(), b = first.film.irradiance();
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-5 * b.pixels[i][c] + 1e-9);

  // Going on from it finds next to nothing left to do.
  RecordCache continued = loaded(job, path);
  build_in_rounds(job, continued);
  EXPECT_LE(static_cast<double>(continued.records().size()), 1.05 * static_cast<double>(records.size()));
  for (std::size_t i = 0; i < records.size(); ++i)
    EXPECT_EQ(continued.records()[i].jet.value, records[i].jet.value) << "record " << i;
}

TEST(RecordFile, ACacheOfAnotherViewIsContinued) {
  const Stage stage("back-wall.glb");
  Job front = stage.job(method("cached", 0.05), 48, 36, 1, "front");
  Job back = stage.job(method("cached", 0.05), 48, 36, 1, "back");
  front.strata = back.strata = Strata::about(100);
  RecordCache cache = empty_cache(front);
  build_in_rounds(front, cache);
  const std::size_t before = cache.records().size();
  build_in_rounds(back, cache);
  const std::size_t alone = render_all(back).cache.records().size();
  EXPECT_GT(cache.records().size(), before);
  EXPECT_LT(cache.records().size(), before + alone) << "places seen from both sides should share records";
}

TEST(RecordFile, AnotherSceneOrOtherSettingsAreRefused) {
  const std::uint64_t scene = scene_hash(scenes::cornell_box()), other = scene_hash(scenes::cornell_box(2));
  const RecordFile file{scene, "a=0.2\nsecondary=true\n", {}, 1, {}};
  require_match("cache.iso", file, scene, file.settings);
  EXPECT_THROW(require_match("cache.iso", file, other, file.settings), UserError);
  EXPECT_THROW(require_match("cache.iso", file, scene, "a=0.1\nsecondary=true\n"), UserError);
}

TEST(SceneHash, SeesWhateverDecidesLightAndNoCamera) {
  const Scene base = scenes::cornell_box();
  const std::uint64_t hash = scene_hash(base);
  EXPECT_EQ(scene_hash(scenes::cornell_box()), hash);
  Scene same = base;
  same.cameras.push_back(Camera{});
  same.meshes[0].name = "floor", same.materials[0].name = "white";
  EXPECT_EQ(scene_hash(same), hash);

  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.meshes[3].positions[2].y += 1e-3f; },
      [](Scene& s) { std::swap(s.meshes[3].triangles[0][0], s.meshes[3].triangles[0][1]); },
      [](Scene& s) { s.meshes[3].material = 0; },
      [](Scene& s) { s.meshes.pop_back(); },
      [](Scene& s) {
        s.meshes[0].normals.assign(4, Vec3{0, 1, 0});
      },
      [](Scene& s) {
        s.meshes[0].colors.assign(4, Rgba{Rgb(0.5f), 1});
      },
      [](Scene& s) { s.materials[0].base_color.g = 0.72f; },
      [](Scene& s) { s.materials[0].roughness = 0.9f; },
      [](Scene& s) { s.materials[3].emission.b = 4.1f; },
      [](Scene& s) { s.materials[3].double_sided = true; },
      [](Scene& s) { s.materials[0].alpha = Alpha::mask; },
      [](Scene& s) { s.lights.emplace_back(); },
      [](Scene& s) { s.environment.radiance = RgbImage(2, 1, Rgb(1)); },
      [](Scene& s) {
        s.textures.emplace_back().rgba = {255, 255, 255, 255};
      },
  };
  std::vector<std::uint64_t> seen{hash};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = base;
    changes[i](changed);
    const std::uint64_t h = scene_hash(changed);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), h), 0) << "change " << i;
    seen.push_back(h);
  }
}

TEST(SceneHash, SeesMedia) {
  const auto grid = [](float value) { return DensityGrid::from_values({1, 1, 2}, {1, value}, {}); };
  Medium fog = scenes::medium(Rgb(1.0f), Rgb(0.5f), {{-1, -1, -1}, {1, 1, 1}});
  const std::vector<std::function<void(Medium&)>> changes = {
      [](Medium&) {},
      [](Medium& m) { m.scattering.g = 1.5f; },
      [](Medium& m) { std::swap(m.scattering, m.absorption); },
      [](Medium& m) { m.emission.b = 1; },
      [](Medium& m) { m.g = 0.1f; },
      [](Medium& m) { std::get<Box>(m.bounds).upper.z = 2; },
      [](Medium& m) {
        m.bounds = scenes::closed_box({-1, -1, -1}, {1, 1, 1});
      },
      [](Medium& m) {
        m.bounds = scenes::closed_box({-1, -1, -1}, {1, 1, 2});
      },
      [](Medium& m) {
        m.density = HeightDensity{0, 1};
      },
      [](Medium& m) {
        m.density = HeightDensity{0, 2};
      },
      [&](Medium& m) { m.density = grid(1); },
      [&](Medium& m) { m.density = grid(2); },
  };
  Scene scene = scenes::cornell_box();
  std::vector<std::uint64_t> seen{scene_hash(scene)};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Medium changed = fog;
    changes[i](changed);
    scene.media = {changed};
    EXPECT_EQ(std::count(seen.begin(), seen.end(), scene_hash(scene)), 0) << "change " << i;
    seen.push_back(scene_hash(scene));
  }
  Medium named = fog;
  named.name = "fog", named.density = grid(2);
  scene.media = {named};
  EXPECT_EQ(scene_hash(scene), seen.back());
}

TEST(RecordPicture, DrawsADotAtEachRecordAndARimAroundIt) {
  const Stage stage(scenes::cornell_box());
  Job job = stage.job(method("uniform"), 128, 128, 1);
  RecordCache cache = empty_cache(job);
  cache.insert(back_wall_record());
  const RgbImage picture = record_picture(job, cache, RecordColour::radius).picture;
  int dot_pixels = 0, coloured = 0, filled = 0, black = 0;
  for (const Rgb& p : picture.pixels) {
    if (p == Rgb(1))
      ++dot_pixels;
    else if (p.r == p.g && p.g == p.b && p.r > 0)
      ++filled;
    else if (is_black(p))
      ++black;
    else
      ++coloured;
  }
  EXPECT_EQ(picture.at(64, 64), Rgb(1));
  EXPECT_GT(dot_pixels, 3);
  EXPECT_LT(dot_pixels, 40);
  EXPECT_GT(filled, 200);
  EXPECT_GT(coloured, 30);
  EXPECT_GT(black, 10000);
}

}  // namespace
}  // namespace isophote::test
