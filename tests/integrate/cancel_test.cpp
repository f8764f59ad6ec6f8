#include <gtest/gtest.h>

#include <algorithm>

#include "integrate/stage.h"

namespace isophote::test {
namespace {

/// The Cornell box, cancelled before its first sample; notes how many rows each call of the host's threads was given.
struct Cancelled {
  Stage stage{"cornell-box.glb"};
  Job job = stage.job(method("ward1992", 0.05), 24, 24, 16);
  std::vector<std::size_t> rows;

  Cancelled() {
    job.strata = Strata::about(50);
    job.progress.cancelled = [] { return true; };
    job.parallel = [this](std::size_t count, std::size_t, const std::function<void(std::size_t, std::size_t)>& body) {
      rows.push_back(count);
      body(0, count);
    };
  }
};

std::uint64_t with_alpha(const Film& film) {
  const ExrFile file = film.exr();
  const std::vector<float>& alpha = file.find("A")->values;
  return static_cast<std::uint64_t>(std::count(alpha.begin(), alpha.end(), 1.0f));
}

TEST(CompletionPass, EmptyRowsAreFinishedInOneGo) {
  Cancelled c;
  const RecordCache nothing = empty_cache(c.job);
  Film film(24, 24);
  const RenderReport report = render(c.job, &nothing, film);
  EXPECT_TRUE(report.cancelled);
  EXPECT_EQ(c.rows, std::vector<std::size_t>{24});
  EXPECT_EQ(film.samples(), 24u * 24u);
}

TEST(CompletionPass, SamplesLeftOutAreUncovered) {
  Cancelled c;
  RecordCache cache = empty_cache(c.job);
  Film whole(24, 24);
  render(c.job, nullptr, whole);
  ASSERT_GT(with_alpha(whole), 24u * 24u / 2);  // path tracing leaves nothing out but the surroundings of the box
  for (const bool lazily : {false, true}) {
    Film film(24, 24);
    const RenderReport report = lazily ? render_lazily(c.job, cache, film).final : render(c.job, &cache, film);
    EXPECT_GT(report.uncovered, 24u * 24u / 2);
    EXPECT_EQ(report.uncovered, with_alpha(whole) - with_alpha(film));
    EXPECT_EQ(film.samples(), 24u * 24u);
  }
}

TEST(CompletionPass, RowsThatHaveSamplesKeepThem) {
  Cancelled c;
  int asked = 0;
  c.job.progress.cancelled = [&] { return ++asked > 3; };  // bands of a row each
  Film film(24, 24);
  render(c.job, nullptr, film);
  EXPECT_EQ(c.rows, (std::vector<std::size_t>{1, 1, 1, 21}));
  for (int y = 0; y < 24; ++y) EXPECT_EQ(film.samples(y), 1);
}

}  // namespace
}  // namespace isophote::test
