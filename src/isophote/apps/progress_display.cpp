#include "isophote/apps/progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace isophote::app {

ProgressDisplay::ProgressDisplay(const std::string& mode)
    : mode_(mode == "json"                                             ? Mode::json
            : mode == "bar" || (mode.empty() && isatty(STDERR_FILENO)) ? Mode::bar
                                                                       : Mode::none) {}

void ProgressDisplay::show(std::string_view phase, double done) {
  if (mode_ == Mode::none) return;
  const Clock now = Clock::now();
  if (phase != phase_)
    phase_ = phase, start_ = now;
  else if (now.wall - last_.wall < 0.1 && done < 1)
    return;
  last_ = now;
  const double spent = now.wall - start_.wall;
  constexpr double enough = 0.02;  // less work than this says nothing about the rest
  const bool known = done >= enough;
  const double left = known ? spent * (1 - done) / done : 0;
  if (mode_ == Mode::json) {
    fmt::print(stderr, "{{\"phase\":\"{}\",\"done\":{:.4f},\"seconds_left\":{}}}\n", phase, done,
               known ? fmt::format("{:.1f}", left) : "null");
    return;
  }
  constexpr int width = 40;
  const int filled = static_cast<int>(std::clamp(done, 0.0, 1.0) * width);
  fmt::print(stderr, "\r{:<6} [{}{}] {:3.0f}%{} \033[K", phase, std::string(filled, '#'),
             std::string(width - filled, '.'), 100 * done, known ? fmt::format("  {:.0f} s left", left) : "");
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressDisplay::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace isophote::app
