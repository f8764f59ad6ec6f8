#pragma once

#include <string>

#include "isophote/integrate/job.h"

namespace isophote::app {

/// A progress report on standard error: a bar with phase and time left, lines of JSON, or nothing. An empty mode means
/// a bar on a terminal and nothing in a pipe. The time left is told once 2% are done. Throttled to ten reports a
/// second.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(const std::string& mode);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(std::string_view phase, double done);
  /// Takes the bar off the terminal, so that other text can be printed.
  void clear();

 private:
  enum class Mode { none, bar, json } mode_;
  std::string phase_;
  Clock start_, last_;
  bool drawn_ = false;
};

}  // namespace isophote::app
