#include <fmt/format.h>

#include "isophote/apps/commands.h"
#include "isophote/cache/catalogue.h"

namespace isophote::app {
namespace {

std::string bounds_text(const RadiusBounds& b) {
  std::string text;
  const auto add = [&](const std::string& s) { text += (text.empty() ? "" : ", ") + s; };
  if (b.min_pixels > 0) add(fmt::format("at least {:g} px", b.min_pixels));
  if (b.max_pixels < std::numeric_limits<float>::infinity()) add(fmt::format("at most {:g} px", b.max_pixels));
  if (b.min_view > 0) add(fmt::format("at least {:g} a heights", b.min_view));
  if (b.gradient) add("gradient");
  if (b.neighbours) add("neighbours");
  return text.empty() ? "none" : text;
}

}  // namespace

int methods() {
  fmt::print("{:<10} {:<20} {:<21} {:<38} {:<10} {}\n", "method", "estimator", "metric", "bounds", "secondary",
             "what it is");
  for (const Method& m : isophote::methods()) {
    if (!m.caches()) {
      fmt::print("{:<10} {:<20} {:<21} {:<38} {:<10} {} {}\n", m.name, "-", "-", "-", "-", m.summary, m.paper);
      continue;
    }
    fmt::print("{:<10} {:<20} {:<21} {:<38} {:<10} {} {}\n", m.name, m.estimator->name, m.metric->name,
               bounds_text(m.settings.bounds), m.secondary ? "on" : "off", m.summary, m.paper);
  }
  fmt::print("\n{:<21} {:<44} {}\n", "estimator", "gives", "paper");
  for (const Estimator& e : estimators()) fmt::print("{:<21} {:<44} {}\n", e.name, e.gives, e.paper);
  fmt::print("\n{:<21} {:<44} {}\n", "metric", "needs", "paper");
  for (const Metric& m : metrics())
    fmt::print("{:<21} {:<44} {}\n", m.name, m.bounded ? "distances; a gradient for the gradient bound" : "distances",
               m.paper);
  return 0;
}

}  // namespace isophote::app
