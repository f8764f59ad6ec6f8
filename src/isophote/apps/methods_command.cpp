#include <fmt/format.h>

#include "isophote/apps/commands.h"
#include "isophote/cache/catalogue.h"

namespace isophote::app {

int methods() {
  fmt::print("{:<10} {:<20} {:<21} {:<47} {:<10} {}\n", "method", "estimator", "metric", "bounds", "secondary",
             "what it is");
  for (const Method& m : isophote::methods()) {
    if (!m.caches()) {
      fmt::print("{:<10} {:<20} {:<21} {:<47} {:<10} {} {}\n", m.name, "-", "-", "-", "-", m.summary, m.paper);
      continue;
    }
    fmt::print("{:<10} {:<20} {:<21} {:<47} {:<10} {} {}\n", m.name, m.estimator->name, m.metric->name,
               describe(m.settings.bounds), m.secondary ? "on" : "off", m.summary, m.paper);
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
