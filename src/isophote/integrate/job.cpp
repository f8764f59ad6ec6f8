#include "isophote/integrate/job.h"

#include <chrono>
#include <ctime>
#include <mutex>

namespace isophote {

RayCounts for_each(const ParallelFor& parallel, std::size_t count, std::size_t grain,
                   const std::function<void(std::size_t, RayCounts&)>& body) {
  RayCounts total;
  std::mutex lock;
  parallel(count, grain, [&](std::size_t begin, std::size_t end) {
    const FlushDenormals flush;
    RayCounts mine;
    for (std::size_t i = begin; i < end; ++i) body(i, mine);
    const std::lock_guard hold(lock);
    total += mine;
  });
  return total;
}

Clock Clock::now() {
  timespec cpu{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec),
          std::chrono::duration<double>(wall).count()};
}

}  // namespace isophote
