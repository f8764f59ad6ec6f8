// Pictures of glossy surfaces whose indirect light comes from records of incident radiance.
#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/cache/radiance_cache.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

/// A metal floor in a room whose walls reflect what a lamp sends to the ceiling.
Scene metal_floor(float roughness, float scale = 1) {
  Scene scene = scenes::cornell_box();
  scene.materials[0] = scenes::diffuse(Rgb(0.73f));
  scene.meshes[0].material = scenes::add(scene, scenes::metal({0.9f, 0.8f, 0.7f}, roughness));
  scene.meshes[5] = scenes::quad({-0.5f, 1.4f, -0.5f}, {0, 0, 1}, {1, 0, 0}, scene.meshes[5].material);
  scene.materials[static_cast<std::size_t>(scene.meshes[5].material)].double_sided = false;
  for (Mesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) p *= scale;
  scene.cameras = {Camera::look_at(Vec3{0, 1.4f, 3.5f} * scale, Vec3{0, 0.2f, 0.2f} * scale, 0.6f)};
  return scene;
}

Job job_of(const Stage& stage, const Method& how, int size = 64, int samples = 16) {
  Job job = stage.job(how, size, size, samples);
  job.strata = Strata::about(400);
  return job;
}

// Under a sky of one radiance a metal reflects its albedo, of any roughness and from anywhere: what the bands cut off
// is not missed there.
TEST(GlossyCache, WhiteFurnace) {
  for (const float roughness : {0.55f, 0.65f, 0.8f, 1.0f}) {
    Scene scene;
    const Material metal = scenes::metal({0.9f, 0.8f, 0.7f}, roughness);
    scene.meshes.push_back(scenes::quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, scenes::add(scene, metal)));
    scene.environment.radiance = RgbImage(4, 2);
    for (Rgb& texel : scene.environment.radiance.pixels) texel = Rgb(1.0f);
    scene.cameras = {Camera::look_at({0, 1.5f, 2}, {0, 0, 0}, 0.5f)};
    const Stage stage(std::move(scene));
    const Job job = job_of(stage, method("cached", 0.05), 24, 64);
    const Rendered r = render_all(job);
    EXPECT_GT(r.cache.radiance()->records().size(), 0u);
    const RgbImage color = r.layer("");
    double sum = 0, expected = 0;
    for (int y = 0; y < job.height; ++y)
      for (int x = 0; x < job.width; ++x) {
        double albedo = 0;
        for (int i = 0; i < job.samples; ++i) {
          Sampler stream = job.sampler(x, y, i);
          RayCounts counts;
          const FirstPoint seen = first_point(job.world, job.camera_ray(x, y, stream), true, stream, counts.camera);
          ASSERT_TRUE(seen.point);
          const Bsdf& bsdf = seen.point->bsdf;
          albedo += luminance(specular_albedo(bsdf, -dot(seen.direction, bsdf.frame.n))) / job.samples;
        }
        sum += luminance(color.at(x, y)), expected += albedo;
        // Some samples may follow rays, which are noisy.
        EXPECT_NEAR(luminance(color.at(x, y)), albedo, 0.06) << roughness << " at " << x << " " << y;
      }
    std::printf("  roughness %.2f: %.2f%% of the furnace\n", roughness, 100 * sum / expected);
    EXPECT_NEAR(sum / expected, 1, 0.004);
  }
}

// Against paths, in the mean over the picture and over blocks of it.
TEST(GlossyCache, ShowsWhatPathsShow) {
  for (const float roughness : {0.55f, 0.7f}) {
    const Stage stage(metal_floor(roughness));
    const RgbImage truth = render_all(job_of(stage, method("path"), 64, 1024)).layer("");
    for (const char* name : {"cached", "krivanek2005a", "krivanek2005b"}) {
      const Rendered r = render_all(job_of(stage, method(name, 0.02)));
      const Difference d = compare(r.layer(""), truth);
      std::printf("  roughness %.2f, %s: %zu records of radiance, bias %+.2f%%, block error %.2f%%\n", roughness, name,
                  r.cache.radiance()->records().size(), 100 * d.bias, 100 * d.block_error);
      EXPECT_LT(std::abs(d.bias), 0.015) << name;
      // Those of the papers gather paths, with all their noise.
      EXPECT_LT(d.block_error, name == std::string("cached") ? 0.04 : 0.1) << name;
      EXPECT_GT(r.cache.radiance()->records().size(), 20u);
    }
  }
}

TEST(GlossyCache, ThreadsDoNotChangeIt) {
  const Stage stage(metal_floor(0.6f));
  Job job = job_of(stage, method("cached", 0.05), 48, 2);
  const auto picture = [&](int threads) {
    job.parallel = thread_for(threads);
    return exr_bytes(render_all(job).exr());
  };
  const std::string serial = picture(1);
  EXPECT_EQ(picture(2), serial);
  EXPECT_EQ(picture(8), serial);
}

TEST(GlossyCache, PowersOfTwoOfTheSizeDoNotChangeIt) {
  const auto picture = [&](float scale) {
    const Stage stage(metal_floor(0.6f, scale));
    return render_all(job_of(stage, method("cached", 0.05), 48, 2)).layer("").pixels;
  };
  const auto base = picture(1);
  EXPECT_EQ(picture(0x1p-10f), base);
  EXPECT_EQ(picture(0x1p13f), base);
}

TEST(GlossyCache, RaysMakeNoRecords) {
  const Stage stage(metal_floor(0.6f));
  Method how = method("cached", 0.05);
  how.glossy.from = Glossy::rays;
  const Rendered r = render_all(job_of(stage, how, 32, 2));
  EXPECT_FALSE(r.cache.radiance());
}

// A plate's two sides see different light, and records of one do not serve the other.
TEST(GlossyCache, TwoSides) {
  Scene scene = metal_floor(0.7f);
  scene.meshes.push_back(scenes::quad({-0.4f, 0.7f, 0.1f}, {0.8f, 0, 0}, {0, 0, 0.5f}, scene.meshes[0].material));
  scene.cameras = {Camera::look_at({0, 0.55f, 1.8f}, {0, 0.7f, 0.3f}, 0.5f),
                   Camera::look_at({0, 1.2f, 1.8f}, {0, 0.7f, 0.3f}, 0.5f)};
  scene.cameras[0].name = "under", scene.cameras[1].name = "over";
  const Stage stage(std::move(scene));
  Job over = stage.job(method("cached", 0.03), 48, 48, 16, "over"),
      under = stage.job(method("cached", 0.03), 48, 48, 16, "under");
  over.strata = under.strata = Strata::about(400);
  RecordCache cache = empty_cache(over);
  build_in_rounds(over, cache);
  const std::size_t before = cache.radiance()->records().size();
  build_in_rounds(under, cache);
  EXPECT_GT(cache.radiance()->records().size(), before);
  Film film(48, 48);
  RayCounts counts;
  const RecordCache shown = regressed(under, cache, counts);
  render(under, &shown, film);
  Job paths = stage.job(method("path"), 48, 48, 1024, "under");
  const Difference d = compare(film.exr().rgb(""), render_all(paths).layer(""));
  EXPECT_LT(std::abs(d.bias), 0.015);
  EXPECT_LT(d.block_error, 0.06);
}

}  // namespace
}  // namespace isophote::test
