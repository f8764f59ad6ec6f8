#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "integrate/stage.h"
#include "isophote/cache/radiance_cache.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

constexpr double asked = 0.05;
constexpr int width = 64, height = 48;
/// Errors are of blocks of 2x2 pixels: small enough to show the seam along a wall, which a larger block hides.
constexpr int block = 2;

/// Irradiance by path tracing: the mean of two pictures of 512 samples a pixel, so that each block is the mean of
/// 4,096 paths. Their difference says how noisy that still is: less than the error asked for, in the median over
/// blocks.
RgbImage reference_irradiance(const Stage& stage, const std::string& camera, int size = block) {
  Job job = stage.job(method("path"), width, height, 512, camera);
  RgbImage a = render_all(job).layer("irradiance");
  job.seed = 1;
  const RgbImage b = render_all(job).layer("irradiance");
  for (std::size_t i = 0; i < a.pixels.size(); ++i) a.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
  // b - (a + b) / 2 has the deviation of the mean of both.
  const double noise = percentile(block_errors(b, a, size), 0.5);
  EXPECT_LT(noise, asked) << "the reference is too noisy";
  return a;
}

RgbImage cached_irradiance(const Stage& stage, const std::string& camera, int rays = 3200, std::uint64_t seed = 0) {
  Job job = stage.job(method("cached", asked), width, height, 16, camera);
  job.seed = seed;
  job.strata = Strata::about(rays);
  return render_all(job).layer("irradiance");
}

/// Through records of another view first.
Rendered rendered_after(const Stage& stage, const std::string& first, const std::string& camera, const Method& how,
                        int rays, std::uint64_t seed = 0) {
  Job before = stage.job(how, width, height, 16, first), job = stage.job(how, width, height, 16, camera);
  before.strata = job.strata = Strata::about(rays);
  before.seed = job.seed = seed;
  Rendered r{Film(width, height), empty_cache(job), empty_cache(job), {}, {}};
  if (first != camera) build_in_rounds(before, r.cache);
  build_in_rounds(job, r.cache);
  RayCounts counts;
  r.shown = how.regress && how.leak_test ? regressed(job, r.cache, counts) : r.cache;
  render(job, &r.shown, r.film);
  return r;
}

RgbImage irradiance_after(const Stage& stage, const std::string& first, const std::string& camera) {
  return rendered_after(stage, first, camera, method("cached", asked), 3200).film.irradiance();
}

/// One of the project's scenes, the floors of its boxes of metal.
Scene with_metal_floors(const std::string& file) {
  Scene scene = Stage(file).scene();
  const int metal = scenes::add(scene, scenes::metal({0.9f, 0.8f, 0.7f}, 0.6f));
  for (std::size_t i = 0, count = scene.meshes.size(); i < count; ++i) {
    Mesh& mesh = scene.meshes[i];
    if (!is_black(scene.materials[static_cast<std::size_t>(mesh.material)].emission)) continue;
    const auto below = [](const Vec3& a, const Vec3& b) { return a.y < b.y; };
    const float lowest = std::min_element(mesh.positions.begin(), mesh.positions.end(), below)->y;
    Mesh floor = mesh;
    floor.material = metal;
    const auto on_floor = [&](const auto& triangle) {
      return std::all_of(triangle.begin(), triangle.end(), [&](auto v) { return mesh.positions[v].y == lowest; });
    };
    std::erase_if(floor.triangles, [&](const auto& triangle) { return !on_floor(triangle); });
    std::erase_if(mesh.triangles, on_floor);
    scene.meshes.push_back(std::move(floor));
  }
  return scene;
}

/// What glossy lobes reflect is cached wherever it can be.
Method glossy_method(const std::string& name) {
  Method how = method(name, asked);
  if (how.glossy.caches()) how.glossy.from = Glossy::cache;
  return how;
}

void expect_within_three_times(const RgbImage& cached, const RgbImage& reference, const std::string& what,
                               int size = block) {
  const std::vector<double> errors = block_errors(cached, reference, size);
  const double p95 = percentile(errors, 0.95);
  std::printf("%s: relative error of %dx%d pixels: median %.4f, 95%% %.4f, asked %.3f\n", what.c_str(), size, size,
              percentile(errors, 0.5), p95, asked);
  EXPECT_LT(p95, 3 * asked) << what;
}

TEST(Leaks, TheClosedBoxStaysExactlyBlack) {
  const Stage stage(with_metal_floors("closed-box.glb"));
  for (const char* camera : {"crate", "closet"}) {
    for (const Method& m : methods()) {
      SCOPED_TRACE(std::string(camera) + " " + m.name);
      Job job = stage.job(glossy_method(m.name), 64, 48, 4, camera);
      job.strata = Strata::about(200);
      const ExrFile picture = render_all(job).exr();
      for (const char* layer : {"", "direct", "indirect", "irradiance"})
        for (const Rgb& pixel : picture.rgb(layer).pixels) ASSERT_EQ(pixel, Rgb{}) << layer;
      EXPECT_GT(mean_luminance(picture.rgb("albedo")), 0.1);
    }
  }
}

/// With many rays a record, so that a leak is not lost in noise; and with as many as one gets without asking, over
/// blocks in which their noise averages out.
void expect_no_leak(const std::string& scene, const std::string& camera) {
  const Stage stage(scene);
  const RgbImage reference = reference_irradiance(stage, camera);
  expect_within_three_times(cached_irradiance(stage, camera), reference, camera);
  expect_within_three_times(cached_irradiance(stage, camera, 800), reference, camera + ", 800 rays", 8);
}

TEST(Leaks, TheDarkSideOfAThinWall) { expect_no_leak("thin-wall.glb", "dark"); }
TEST(Leaks, UnderThePlate) { expect_no_leak("plate.toml", "under"); }

/// Bounced sunlight under a plate is found by few rays, of records and of the reference alike: it takes more of the
/// former and larger blocks of the latter, or noise is all there is to see.
TEST(SlowLeaks, UnderThePlateBesideSunlitGround) {
  const Stage stage("plate-sun.toml");
  expect_within_three_times(cached_irradiance(stage, "under", 6400), reference_irradiance(stage, "under", 8),
                            "plate in the sun", 8);
}

/// Records of the bright room are there too, up to 2 cm away, as when one cache serves a walk through both:
/// footprints reach across the wall, and it is the leak test alone that keeps the dark room dark. `seen` says how much
/// light a picture has. It takes several seeds, for all records share what cells have by chance, about a percent.
void expect_dark_among_the_bright_rooms_records(const Stage& stage, Method how, int rays, std::uint64_t seeds,
                                                const std::function<double(const Rendered&)>& seen) {
  double alone = 0, tested = 0, untested = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    how.leak_test = true;
    alone += seen(rendered_after(stage, "dark", "dark", how, rays, seed));
    tested += seen(rendered_after(stage, "bright", "dark", how, rays, seed));
    how.leak_test = false;
    untested += seen(rendered_after(stage, "bright", "dark", how, rays, seed));
  }
  std::printf("dark room after the bright one: %+.3f with the leak test, %+.3f without\n", tested / alone - 1,
              untested / alone - 1);
  EXPECT_NEAR(tested / alone, 1, 0.03);
  EXPECT_GT(untested / alone, 1.1) << "this scene no longer shows a leak";
}

TEST(Leaks, TheDarkRoomStaysDarkAmongTheBrightOnesRecords) {
  expect_dark_among_the_bright_rooms_records(Stage("thin-wall.glb"), method("cached", asked), 800, 4,
                                             [](const Rendered& r) { return mean_luminance(r.film.irradiance()); });
}

/// Records of incident radiance, by what the metal shows of them.
TEST(Leaks, TheDarkMetalFloorStaysDarkAmongTheBrightOnesRecords) {
  expect_dark_among_the_bright_rooms_records(
      Stage(with_metal_floors("thin-wall.glb")), glossy_method("cached"), 400, 2, [](const Rendered& r) {
        const ExrFile picture = r.exr();
        const RgbImage diffuse = picture.rgb("albedo");
        return mean_luminance(picture.rgb("indirect"), [&](std::size_t i) { return is_black(diffuse.pixels[i]); });
      });
}

/// Crate and closet have walls without thickness, and the lit room's records stand all round them.
TEST(Leaks, TheClosedBoxStaysExactlyBlackAmongTheRoomsRecords) {
  const Stage stage(with_metal_floors("closed-box.glb"));
  for (const char* camera : {"crate", "closet"}) {
    const Rendered r = rendered_after(stage, "room", camera, glossy_method("cached"), 400);
    EXPECT_GT(r.cache.radiance()->records().size(), 50u);
    for (const RgbImage& layer : {r.film.irradiance(), r.film.color()})
      for (const Rgb& pixel : layer.pixels) ASSERT_EQ(pixel, Rgb{}) << camera;
  }
}

/// Its records see nothing on it, which is convex, and those of the floor about it see it.
TEST(Leaks, ASphereTakesFewRecordsMore) {
  const Stage stage("sphere.glb");
  const auto records = [&](bool leak_test) {
    Job job = stage.job(method("cached", asked), 96, 72, 1);
    job.method.leak_test = leak_test;
    job.strata = Strata::about(200);
    RecordCache cache = empty_cache(job);
    build_in_rounds(job, cache);
    return static_cast<double>(cache.records().size());
  };
  EXPECT_LT(records(true), 1.03 * records(false));
}

TEST(SlowLeaks, TheDarkSideOfAThinWallWithTheBrightSidesRecords) {
  const Stage stage("thin-wall.glb");
  expect_within_three_times(irradiance_after(stage, "bright", "dark"), reference_irradiance(stage, "dark"),
                            "dark room after the bright one");
}

TEST(SlowLeaks, TheCornerOfThreePlanes) {
  const Stage stage("corner.glb");
  expect_within_three_times(cached_irradiance(stage, "corner"), reference_irradiance(stage, "corner"), "corner");
}

/// A ray that meets the edge where three walls join may be given to any of them, also to one on its far side.
TEST(SlowLeaks, TheClosedBoxStaysExactlyBlackOverManyRays) {
  const Stage stage("closed-box.glb");
  for (const char* camera : {"closet", "crate"}) {
    Job job = stage.job(method("path"), 256, 192, 128, camera);
    job.seed = 1;
    int lit = 0;
    for (const Rgb& pixel : render_all(job).layer("").pixels) lit += !is_black(pixel);
    EXPECT_EQ(lit, 0) << "pixels that are not black in the " << camera;
  }
}

TEST(TwoSidedWall, HasRecordsOnBothSides) {
  const Stage stage("back-wall.glb");
  const Job front = stage.job(method("cached", asked), width, height, 1, "front");
  const Job back = stage.job(method("cached", asked), width, height, 1, "back");
  RecordCache cache = empty_cache(front);
  build_in_rounds(front, cache);
  build_in_rounds(back, cache);
  int towards_front = 0, towards_back = 0;
  for (const Record& r : cache.records()) {
    if (std::abs(r.position.x - 3) > 1e-4f) continue;
    towards_front += r.normal.x<-0.99f, towards_back += r.normal.x> 0.99f;
  }
  EXPECT_GT(towards_front, 5);
  EXPECT_GT(towards_back, 5);
}

TEST(SlowTwoSidedWall, EachSideHasItsOwnLight) {
  const Stage stage("back-wall.glb");
  for (const char* side : {"front", "back"}) {
    const RgbImage reference = reference_irradiance(stage, side);
    expect_within_three_times(cached_irradiance(stage, side), reference, std::string(side) + " of the wall");
    expect_within_three_times(irradiance_after(stage, side == std::string("front") ? "back" : "front", side), reference,
                              std::string(side) + " of the wall after the other");
  }
}

}  // namespace
}  // namespace isophote::test
