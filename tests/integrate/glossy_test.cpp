// Pictures of glossy surfaces whose indirect light comes from records of incident radiance.
#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "isophote/cache/radiance_cache.h"
#include "isophote/integrate/glossy_lobes.h"
#include "support/scenes.h"
#include "support/statistics.h"

namespace isophote::test {
namespace {

Material metal(float roughness) { return scenes::metal({0.9f, 0.8f, 0.7f}, roughness); }

/// A room whose walls reflect what a lamp sends to the ceiling.
Scene room_with_floor(const Material& floor, float scale = 1) {
  Scene scene = scenes::cornell_box();
  scene.materials[0] = scenes::diffuse(Rgb(0.73f));
  scene.meshes[0].material = scenes::add(scene, floor);
  scene.meshes[5] = scenes::quad({-0.5f, 1.4f, -0.5f}, {0, 0, 1}, {1, 0, 0}, scene.meshes[5].material);
  scene.materials[static_cast<std::size_t>(scene.meshes[5].material)].double_sided = false;
  for (Mesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) p *= scale;
  scene.cameras = {Camera::look_at(Vec3{0, 1.4f, 3.5f} * scale, Vec3{0, 0.2f, 0.2f} * scale, 0.6f)};
  return scene;
}

Job job_of(const Stage& stage, const Method& how, int size = 64, int samples = 16, const std::string& camera = "") {
  Job job = stage.job(how, size, size, samples, camera);
  job.strata = Strata::about(400);
  return job;
}

/// A sheet of metal between sky above and sky below.
Scene metal_sheet(float roughness, RgbImage sky) {
  Scene scene;
  scene.meshes.push_back(scenes::quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, scenes::add(scene, metal(roughness))));
  scene.environment.radiance = std::move(sky);
  for (const float side : {1.0f, -1.0f}) scene.cameras.push_back(Camera::look_at({0, 1.5f * side, 2}, {0, 0, 0}, 0.5f));
  scene.cameras[0].name = "over", scene.cameras[1].name = "under";
  return scene;
}

/// What a metal reflects of radiance 1 from everywhere, in the mean over a pixel's samples.
Rgb albedo_seen(const Job& job, int x, int y) {
  Rgb sum;
  for (int i = 0; i < job.samples; ++i) {
    Sampler stream = job.sampler(x, y, i);
    RayCounts counts;
    const FirstPoint seen = first_point(job.world, job.camera_ray(x, y, stream), true, stream, counts.camera);
    const Bsdf& bsdf = seen.point.value().bsdf;
    sum += specular_albedo(bsdf, -dot(seen.direction, bsdf.frame.n));
  }
  return sum / static_cast<float>(job.samples);
}

/// What the table of albedos, by which such pictures are judged, is wrong by where nothing is grazing (ggx.h).
constexpr double table_error = 1e-3;

// Under a sky of one radiance a metal reflects its albedo, of any roughness and from anywhere: such a sky lies in the
// first band, and what is missed of a lobe in those left out does not show. Where rays share in it there is noise.
TEST(GlossyCache, WhiteFurnace) {
  for (const float roughness : {0.45f, 0.5f, 0.55f, 0.65f, 0.8f, 1.0f}) {
    const Stage stage(metal_sheet(roughness, RgbImage(4, 2, Rgb(1.0f))));
    for (const Glossy from : {Glossy::cache, Glossy::automatic}) {
      Job job = job_of(stage, method("cached", 0.05), 24, 4);
      job.method.glossy.from = from;
      const Rendered r = render_all(job);
      const RgbImage color = r.layer("");
      statistics::Estimate reflected;
      double worst = 0;
      for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x) {
          const double ratio = color.at(x, y).g / albedo_seen(job, x, y).g;
          reflected.add(ratio);
          worst = std::max(worst, std::abs(ratio - 1));
        }
      EXPECT_NEAR(reflected.mean(), 1, table_error + 4.5 * reflected.standard_error());
      std::printf("  roughness %.2f, %s: %+.4f%%, a pixel %.3f%%\n", roughness, name_of(from).data(),
                  100 * (reflected.mean() - 1), 100 * worst);
      if (from != Glossy::cache) continue;
      ASSERT_GT(r.cache.radiance()->records().size(), 0u);
      const int bands = RadianceCache::bands(r.cache.radiance()->records()[0]);
      const float cos_45 = std::sqrt(0.5f), alpha = roughness * roughness;
      std::printf("    %d bands, which miss %.1f%% of the lobe\n", bands,
                  100 * glossy_lobes(Basis::hemispherical).truncation(alpha, cos_45)[bands]);
      EXPECT_LT(worst, table_error);
    }
  }
}

/// Under a coat that reflects more than a quarter, so that all of it is cached.
Material coated(float roughness) {
  Material material = scenes::diffuse({0.5f, 0.4f, 0.3f});
  material.specular = 1, material.ior = 3.2f, material.roughness = roughness;
  return material;
}

/// The mean of pictures from records of radiance that differ in their random numbers.
RgbImage mean_picture(Job job, int pictures) {
  RgbImage sum(job.width, job.height);
  for (job.seed = 0; job.seed < static_cast<std::uint64_t>(pictures); ++job.seed) {
    const Rendered r = render_all(job);
    EXPECT_GT(r.cache.radiance()->records().size(), 20u);
    const RgbImage each = r.layer("");
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += each.pixels[i] / static_cast<float>(pictures);
  }
  return sum;
}

/// Against paths, in the mean over the picture and over blocks of it; the noise of paths cancels between two pictures.
void expect_what_paths_show(const Material& floor) {
  constexpr double asked = 0.02;
  const Stage stage(room_with_floor(floor));
  Job paths = job_of(stage, method("path"), 64, 256);
  const RgbImage first = render_all(paths).layer("");
  paths.seed = 1;
  const RgbImage second = render_all(paths).layer("");
  // Standard deviations of a picture's mean, measured over seeds: those of the papers gather paths, with all their
  // noise, which blocks show too.
  constexpr double of_paths = 0.0017;
  const struct {
    const char* name;
    int pictures;
    double deviation, block_error;
  } methods[] = {{"cached", 3, 0.0045, asked}, {"krivanek2005a", 1, 0.014, 0.1}, {"krivanek2005b", 1, 0.014, 0.1}};
  for (const auto& m : methods) {
    const Difference d = compare(mean_picture(job_of(stage, method(m.name, asked)), m.pictures), first, second);
    std::printf("  %s: bias %+.2f%%, block error %.2f%%\n", m.name, 100 * d.bias, 100 * d.block_error);
    EXPECT_LT(std::abs(d.bias), 4.5 * std::hypot(m.deviation / std::sqrt(m.pictures), of_paths)) << m.name;
    EXPECT_LT(d.block_error, m.block_error) << m.name;
  }
}

TEST(GlossyCache, ShowsWhatPathsShow) { expect_what_paths_show(metal(0.55f)); }
TEST(GlossyCache, ShowsWhatPathsShowInRougherMetal) { expect_what_paths_show(metal(0.7f)); }
/// Over a diffuse base, whose irradiance is cached too.
TEST(GlossyCache, ShowsWhatPathsShowInACoat) { expect_what_paths_show(coated(0.7f)); }

TEST(GlossyCache, ThreadsDoNotChangeIt) {
  const Stage stage(room_with_floor(metal(0.6f)));
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
    const Stage stage(room_with_floor(metal(0.6f), scale));
    return render_all(job_of(stage, method("cached", 0.05), 48, 2)).layer("").pixels;
  };
  const auto base = picture(1);
  EXPECT_EQ(picture(0x1p-10f), base);
  EXPECT_EQ(picture(0x1p13f), base);
}

TEST(GlossyCache, RaysMakeNoRecords) {
  const Stage stage(room_with_floor(metal(0.6f)));
  Method how = method("cached", 0.05);
  how.glossy.from = Glossy::rays;
  const Rendered r = render_all(job_of(stage, how, 32, 2));
  EXPECT_FALSE(r.cache.radiance());
}

// A sheet's two sides see different light, red above and green below, and records of the one do not serve the other,
// whichever were there first.
TEST(GlossyCache, TwoSides) {
  // Of so many rows that next to nothing lies along the horizon, where the sky is black lest it shine across.
  RgbImage sky(4, 4096);
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) sky.at(x, y) = {y < 2047 ? 1.0f : 0.0f, y > 2048 ? 1.0f : 0.0f, 0};
  const Stage stage(metal_sheet(0.7f, std::move(sky)));
  Method how = method("cached", 0.05);
  how.glossy.from = Glossy::cache;
  const Job over = job_of(stage, how, 24, 4, "over"), under = job_of(stage, how, 24, 4, "under");
  for (const bool over_first : {true, false}) {
    RecordCache cache = empty_cache(over);
    build_in_rounds(over_first ? over : under, cache);
    build_in_rounds(over_first ? under : over, cache);
    RayCounts counts;
    const RecordCache shown = regressed(over, cache, counts);
    for (const Job& job : {over, under}) {
      Film film(job.width, job.height);
      render(job, &shown, film);
      const RgbImage color = film.color();
      const int own = job.camera.name == "over" ? 0 : 1;
      for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x) {
          EXPECT_NEAR(color.at(x, y)[own] / albedo_seen(job, x, y)[own], 1, table_error);
          EXPECT_EQ(color.at(x, y)[1 - own], 0);
        }
    }
  }
}

}  // namespace
}  // namespace isophote::test
