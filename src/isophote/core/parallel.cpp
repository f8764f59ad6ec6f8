#include "isophote/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace isophote {

ParallelFor serial_for() {
  return [](std::size_t count, std::size_t, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count > 0) body(0, count);
  };
}

ParallelFor thread_for(int threads) {
  return [threads](std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    grain = std::max<std::size_t>(grain, 1);
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failure_lock;
    const auto work = [&] {
      try {
        for (std::size_t begin; (begin = next.fetch_add(grain)) < count;) body(begin, std::min(count, begin + grain));
      } catch (...) {
        const std::lock_guard hold(failure_lock);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    };
    {
      std::vector<std::jthread> crew;  // joined also where starting another one fails
      for (int i = 1; i < threads; ++i) crew.emplace_back(work);
      work();
    }
    if (failure) std::rethrow_exception(failure);
  };
}

}  // namespace isophote
