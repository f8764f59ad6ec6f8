#include <gtest/gtest.h>

#include <filesystem>

#include "integrate/stage.h"

// Against a picture of another renderer, where its scene is at hand.
namespace isophote::test {
namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sa += a[i], sb += b[i], aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  return (ab - sa * sb / n) / std::sqrt((aa - sa * sa / n) * (bb - sb * sb / n));
}

TEST(SlowReference, ThePathTracedCornellBoxIsThatOfAnotherRenderer) {
  const std::string folder = std::string(ISOPHOTE_SOURCE_DIR) + "/../shared/scenes/cornell-box/";
  if (!std::filesystem::exists(folder + "cornell-box.glb")) GTEST_SKIP() << folder << " is absent";
  const Stage stage(load_scene(folder + "cornell-box.glb", [](const std::string&) {}).scene);
  const RgbImage reference = block_average(read_exr(folder + "TungstenRender.exr").rgb(""), 2);
  ASSERT_EQ(reference.width, 512);

  const Rendered r = render_all(stage.job(method("path"), 512, 512, 64));
  const RgbImage picture = block_average(r.layer(""), 16), truth = block_average(reference, 16);
  // Blocks that show the lamp, or border on one that does: its radiance is ten times that of anything else.
  const double lamp = 3 * mean_luminance(truth);
  const auto near_lamp = [&](int x, int y) {
    for (int v = std::max(0, y - 1); v <= std::min(truth.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(truth.width - 1, x + 1); ++u)
        if (luminance(Rgbd(truth.at(u, v))) > lamp) return true;
    return false;
  };
  std::vector<double> ratios, ours, theirs;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const double a = luminance(Rgbd(picture.at(x, y))), b = luminance(Rgbd(truth.at(x, y)));
      if (near_lamp(x, y) || !(b > 0)) continue;
      ratios.push_back(a / b), ours.push_back(a), theirs.push_back(b);
    }
  const double median = percentile(ratios, 0.5), agreement = correlation(ours, theirs);
  std::printf("%zu of %zu blocks: median ratio %.5f (5%% %.4f, 95%% %.4f), correlation %.5f\n", ratios.size(),
              truth.pixels.size(), median, percentile(ratios, 0.05), percentile(ratios, 0.95), agreement);
  EXPECT_GT(ratios.size(), truth.pixels.size() * 3 / 4);
  EXPECT_NEAR(median, 1, 0.005);
  EXPECT_GE(agreement, 0.998);
}

}  // namespace
}  // namespace isophote::test
