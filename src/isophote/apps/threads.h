#pragma once

#include "isophote/core/parallel.h"

namespace isophote::app {

/// The process's worker threads, shared by everything that computes; one of these lives in `render`.
class Threads {
 public:
  /// 0: as many as the machine has.
  explicit Threads(int count);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  int count() const { return count_; }
  ParallelFor parallel_for() const;

 private:
  struct Impl;
  Impl* impl_;
  int count_;
};

/// From here on Ctrl-C and SIGTERM only set a flag; the second one ends the process at once. Restored at destruction.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  static bool interrupted();
};

}  // namespace isophote::app
