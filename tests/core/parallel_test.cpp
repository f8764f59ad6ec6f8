#include "isophote/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace isophote {
namespace {

TEST(Parallel, EveryIndexOnce) {
  for (const ParallelFor& loop : {serial_for(), thread_for(1), thread_for(2), thread_for(8)})
    for (const std::size_t count : {0, 1, 7, 1000, 4096})
      for (const std::size_t grain : {0, 1, 3, 64, 5000}) {
        std::vector<std::atomic<int>> visits(count);
        loop(count, grain, [&](std::size_t begin, std::size_t end) {
          ASSERT_LE(begin, end);
          ASSERT_LE(end, count);
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1) << i;
      }
}

TEST(Parallel, PiecesAreNoSmallerThanTheGrain) {
  thread_for(4)(1000, 64, [](std::size_t begin, std::size_t end) { EXPECT_TRUE(end - begin >= 64 || end == 1000); });
}

TEST(Parallel, RethrowsAndStops) {
  for (const int threads : {1, 4}) {
    std::atomic<std::size_t> visited = 0;
    const auto loop = [&] {
      thread_for(threads)(1000000, 1, [&](std::size_t begin, std::size_t) {
        ++visited;
        if (begin == 10) throw std::runtime_error("at ten");
      });
    };
    try {
      loop();
      FAIL() << "the exception was lost";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "at ten");
    }
    if (threads == 1) {
      EXPECT_EQ(visited, 11u);
    }
  }
  EXPECT_THROW(serial_for()(1, 1, [](std::size_t, std::size_t) { throw std::runtime_error("x"); }), std::runtime_error);
}

}  // namespace
}  // namespace isophote
