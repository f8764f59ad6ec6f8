#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/media.h"

namespace isophote::test {
namespace {

Scene foggy_box(const Rgb& scattering, const Rgb& absorption, float g) {
  Scene scene = scenes::cornell_box();
  scene.media.push_back(scenes::medium(scattering, absorption, {{-1, 0, -1}, {1, 2, 1}}, g));
  return scene;
}

/// Mean of whole pictures against those of paths.
void expect_mean_level(const Stage& stage, const char* name, double tolerance) {
  const auto level = [&](const char* how, int samples) {
    const Rendered r = render_all(stage.job(method(how), 48, 48, samples));
    return mean_luminance(r.layer("direct")) + mean_luminance(r.layer("indirect"));
  };
  const double paths = level("path", 512);
  EXPECT_NEAR(level(name, 64) / paths, 1, tolerance) << name;
}

TEST(MediaCaches, SurfaceCachesInFogKeepTheMeanLevel) {
  const Stage stage(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), 0.3f));
  for (const char* name : {"bounded", "cached"}) expect_mean_level(stage, name, 0.01);
}

TEST(MediaCaches, CachedMediaKeepTheMeanLevel) {
  for (const float g : {0.0f, 0.4f}) {
    const Stage stage(foggy_box({0.3f, 0.4f, 0.5f}, Rgb(0.1f), g));
    expect_mean_level(stage, "jarosz2008a", 0.01);
  }
}

}  // namespace
}  // namespace isophote::test
