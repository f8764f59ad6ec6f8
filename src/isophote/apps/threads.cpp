#include "isophote/apps/threads.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <csignal>

namespace isophote::app {

struct Threads::Impl {
  tbb::global_control control;
};

Threads::Threads(int count) : count_(count > 0 ? count : tbb::info::default_concurrency()) {
  impl_ = new Impl{tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_))};
}
Threads::~Threads() { delete impl_; }

ParallelFor Threads::parallel_for() const {
  return [](std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(grain, 1)),
                      [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
  };
}

namespace {
volatile std::sig_atomic_t interrupt_count = 0;

void on_interrupt(int signal) {
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}
}  // namespace

Interruptible::Interruptible() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
Interruptible::~Interruptible() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}
bool Interruptible::interrupted() { return interrupt_count > 0; }

}  // namespace isophote::app
