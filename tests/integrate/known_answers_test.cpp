#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"
#include "support/statistics.h"

// Scenes whose light is known in closed form, for path tracing and for caches alike.
namespace isophote::test {
namespace {

using statistics::Estimate;
using statistics::expect_mean;

const Rgb albedo{0.2f, 0.5f, 0.7f}, emitted{3, 2, 1};

/// In a closed room of one material radiance is e / (1 - a) everywhere. Light that the walls emit is direct light where
/// it first falls; what is left of the irradiance is pi (e / (1 - a) - e) = pi e a / (1 - a).
double furnace_irradiance(int channel) { return M_PI * emitted[channel] * albedo[channel] / (1 - albedo[channel]); }

Stage furnace() { return Stage(scenes::room(scenes::emissive(albedo, emitted))); }

TEST(Furnace, PathTracingGivesTheSumOfTheSeries) {
  const Stage stage = furnace();
  const Rendered r = render_all(stage.job(method("path"), 64, 64, 16));
  const RgbImage irradiance = r.layer("irradiance"), color = r.layer("");
  for (int c = 0; c < 3; ++c) {
    Estimate indirect, radiance;
    for (std::size_t i = 0; i < color.pixels.size(); ++i)
      indirect.add(irradiance.pixels[i][c]), radiance.add(color.pixels[i][c]);
    expect_mean(indirect, furnace_irradiance(c), 0.003);
    expect_mean(radiance, emitted[c] / (1 - albedo[c]), 0.003);
  }
}

/// Without secondary caching records are independent estimates of the same number.
TEST(Furnace, RecordsOfPathsAreUnbiased) {
  const Stage stage = furnace();
  for (const char* name : {"ward1988", "ward1992", "bounded", "jarosz2012", "schwarzhaupt2012", "swept", "uniform"}) {
    SCOPED_TRACE(name);
    Job job = stage.job(method(name, 0.1), 64, 64, 1);
    job.strata = Strata::about(200);
    const Rendered r = render_all(job);
    for (int c = 0; c < 3; ++c) {
      Estimate value;
      for (const Record& record : r.cache.records()) value.add(record.jet.value[c]);
      expect_mean(value, furnace_irradiance(c), 0.01);
    }
  }
}

TEST(Furnace, CachesGiveTheSumOfTheSeriesWhateverGathersRead) {
  const Stage stage = furnace();
  for (const Secondary secondary : {Secondary::off, Secondary::cells, Secondary::records, Secondary::automatic}) {
    SCOPED_TRACE(name_of(secondary));
    Job job = stage.job(method("cached", 0.02), 64, 64, 4);
    job.method.secondary = secondary;
    const Rendered r = render_all(job);
    const RgbImage irradiance = r.layer("irradiance"), color = r.layer("");
    for (int c = 0; c < 3; ++c) {
      Estimate indirect, radiance;
      for (std::size_t i = 0; i < color.pixels.size(); ++i)
        indirect.add(irradiance.pixels[i][c]), radiance.add(color.pixels[i][c]);
      EXPECT_NEAR(indirect.mean() / furnace_irradiance(c), 1, 0.005) << "channel " << c;
      EXPECT_NEAR(radiance.mean() / (emitted[c] / (1 - albedo[c])), 1, 0.005) << "channel " << c;
    }
  }
}

/// Every surface emits what it does not reflect: radiance is 1 everywhere, seen through mirrors and glass too, whatever
/// the geometry. Emission is direct light where it first falls, so that what is cached does vary.
Scene radiance_one_room() {
  Scene scene;
  const auto closed = [&](const Rgb& a) {
    Material m = scenes::emissive(a, Rgb(1) - a);
    m.double_sided = true;
    return scenes::add(scene, m);
  };
  scene.meshes = {
      scenes::box({-1, -1, -1}, {1, 1, 1}, true, closed({0.8f, 0.6f, 0.4f})),
      scenes::box({-0.8f, -1, -0.5f}, {-0.2f, 0.2f, 0.1f}, false, closed({0.1f, 0.3f, 0.9f})),
      scenes::quad({0.2f, -1, -0.7f}, {0.7f, 0.1f, 0.2f}, {0, 1.2f, 0.1f},
                   scenes::add(scene, scenes::metal(Rgb(1), 0))),
      scenes::box({0.1f, -0.95f, -0.1f}, {0.5f, -0.55f, 0.3f}, false, scenes::add(scene, scenes::glass(1.5f)))};
  scene.cameras.push_back(Camera::look_at({0, 0, 0.95f}, {0, -0.3f, 0}, 1.3f));
  return scene;
}

TEST(RadianceOneRoom, PathTracing) {
  const Stage stage(radiance_one_room());
  const Rendered r = render_all(stage.job(method("path"), 64, 64, 64));
  const RgbImage color = r.layer("");
  for (int c = 0; c < 3; ++c) {
    Estimate e;
    for (const Rgb& pixel : color.pixels) e.add(pixel[c]);
    expect_mean(e, 1, 0.002);
  }
}

TEST(RadianceOneRoom, EveryCachingMethod) {
  const Stage stage(radiance_one_room());
  for (const Method& m : methods()) {
    if (!m.caches()) continue;
    SCOPED_TRACE(m.name);
    constexpr double asked = 0.05;
    Job job = stage.job(method(m.name, asked), 48, 48, 16);
    job.strata = Strata::about(400);
    const Rendered r = render_all(job);
    const RgbImage color = block_average(r.layer(""), 8);
    for (int c = 0; c < 3; ++c) {
      Estimate e, error;
      for (const Rgb& pixel : color.pixels) e.add(pixel[c]), error.add(std::abs(pixel[c] - 1));
      EXPECT_NEAR(e.mean(), 1, asked / 2) << "channel " << c;
      EXPECT_LT(error.mean(), asked) << "channel " << c;
    }
  }
}

/// Under a sky of radiance 1 a plane that sees nothing else receives pi: exactly, since every gather ray brings 1.
Scene plane_under_sky() {
  Scene scene;
  scene.meshes = {scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, scenes::add(scene, scenes::diffuse(albedo)))};
  scene.environment.radiance = RgbImage(8, 4, Rgb(1));
  scene.cameras.push_back(Camera::look_at({0, 2, 6}, {0, 0, 0}, 1.2f));
  return scene;
}

TEST(OpenSky, APlaneReceivesPi) {
  const Stage stage(plane_under_sky());
  const ExrFile picture = render_all(stage.job(method("cached"), 64, 64, 4)).exr();
  const RgbImage irradiance = picture.rgb("irradiance"), color = picture.rgb(""), direct = picture.rgb("direct");
  const std::vector<float>& alpha = picture.find("A")->values;
  int ground = 0, sky = 0;
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (alpha[i] == 1) {
        EXPECT_NEAR(irradiance.pixels[i][c], M_PI, 1e-5);
        EXPECT_NEAR(color.pixels[i][c], albedo[c], 1e-6);
        EXPECT_EQ(direct.pixels[i][c], 0);
      } else if (alpha[i] == 0) {
        EXPECT_EQ(color.pixels[i][c], 1);
        EXPECT_EQ(irradiance.pixels[i][c], 0);
      }
    }
    ground += alpha[i] == 1, sky += alpha[i] == 0;
  }
  EXPECT_GT(ground, 1000);
  EXPECT_GT(sky, 500);
}

/// The same light by path tracing, whose light samples of the sky are indirect light by definition.
TEST(OpenSky, PathTracingAgrees) {
  const Stage stage(plane_under_sky());
  const ExrFile picture = render_all(stage.job(method("path"), 64, 64, 16)).exr();
  const RgbImage irradiance = picture.rgb("irradiance");
  const std::vector<float>& alpha = picture.find("A")->values;
  Estimate e;
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] == 1) e.add(irradiance.pixels[i].g);
  expect_mean(e, M_PI, 0.003);
}

}  // namespace
}  // namespace isophote::test
