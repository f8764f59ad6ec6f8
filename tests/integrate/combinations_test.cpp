#include <gtest/gtest.h>

#include <algorithm>

#include "integrate/stage.h"
#include "isophote/core/error.h"

// Every method in full but small; every other pair of an estimator and a metric by one picture.
namespace isophote::test {
namespace {

/// As the program would run it, but with few rays where their number is given.
Rendered small(const Stage& stage, const Method& preset, int threads = 2, const std::string& camera = "") {
  Method m = preset;
  if (m.caches()) m.settings.a = threshold(*m.metric, 0.1);
  Job job = stage.job(m, 64, 64, 1, camera);
  job.strata = Strata::about(200);
  job.parallel = thread_for(threads);
  return render_all(job);
}

TEST(Methods, DoNotDependOnThreads) {
  const Stage stage("cornell-box.glb");
  for (const Method& m : methods()) {
    const Rendered one = small(stage, m, 1), many = small(stage, m, 8);
    EXPECT_TRUE(exr_bytes(one.exr()) == exr_bytes(many.exr())) << m.name;
    EXPECT_TRUE(record_bytes(one.cache) == record_bytes(many.cache)) << m.name;
  }
}

TEST(Methods, ScaleWithTheScene) {
  const Stage base("cornell-box.glb"), large("cornell-box-times-8192.glb");
  for (const Method& m : methods()) {
    const RgbImage a = small(base, m).layer(""), b = small(large, m).layer("");
    EXPECT_TRUE(a.pixels == b.pixels) << m.name;
  }
}

TEST(Methods, KeepTheTwoSidesOfAWallApart) {
  const Stage stage("back-wall.glb");
  for (const Method& m : methods()) {
    const double front =
        mean_luminance(small(stage, m, 2, "front").layer("irradiance"), [](std::size_t) { return true; });
    const double back =
        mean_luminance(small(stage, m, 2, "back").layer("irradiance"), [](std::size_t) { return true; });
    EXPECT_GT(front, 3 * back) << m.name;
    EXPECT_GT(back, 0) << m.name;
  }
}

/// Neither negative nor beyond numbers anywhere, and as bright as paths say to within what few rays allow.
TEST(Combinations, GiveAPictureEach) {
  const Stage stage("cornell-box.glb");
  Job reference = stage.job(method("path"), 32, 32, 64);
  const RgbImage truth = render_all(reference).layer("irradiance");
  int pictures = 0;
  double largest = 0;
  for (const Estimator& e : estimators())
    for (const Metric& metric : metrics())
      for (const Falloff falloff : {Falloff::ward, Falloff::tent, Falloff::tabellion}) {
        RgbImage before;
        for (int order = 0; order <= e.order; ++order) {
          Method m{"", "", "", &e, &metric};
          m.settings.a = threshold(metric, 0.05);
          m.settings.falloff = falloff;
          m.order = order;
          if (e.order < metric.needs) {
            EXPECT_THROW(check_combination(m), UsageError);
            continue;
          }
          SCOPED_TRACE(std::string(e.name) + " " + std::string(metric.name) + " " + std::to_string(order));
          check_combination(m);
          Job job = stage.job(m, 32, 32, 1);
          job.strata = Strata::about(100);
          const RgbImage image = render_all(job).layer("irradiance");
          for (const Rgb& p : image.pixels) ASSERT_TRUE(is_finite(p) && std::min({p.r, p.g, p.b}) >= 0);
          const double bias = std::abs(compare(image, truth).bias);
          EXPECT_LT(bias, 0.04);
          largest = std::max(largest, bias);
          EXPECT_TRUE(image.pixels != before.pixels) << "an order more changes nothing";
          before = image;
          ++pictures;
        }
      }
  std::printf("%d combinations, largest bias %.1f %%\n", pictures, 100 * largest);
}

}  // namespace
}  // namespace isophote::test
