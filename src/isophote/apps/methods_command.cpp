#include <fmt/format.h>

#include <string>
#include <vector>

#include "isophote/apps/commands.h"
#include "isophote/apps/table.h"
#include "isophote/cache/catalogue.h"

namespace isophote::app {
int methods() {
  std::vector<Row> rows = {{"method", "estimator", "metric", "bounds", "secondary", "glossy", "media", "what it is"}};
  for (const Method& m : isophote::methods()) {
    const std::string what = std::string(m.summary) + (m.paper.empty() ? "" : " ") + std::string(m.paper);
    if (m.caches())
      rows.push_back({std::string(m.name), std::string(m.estimator->name), std::string(m.metric->name),
                      describe(m.settings.bounds), std::string(name_of(m.secondary)),
                      std::string(name_of(m.glossy.from)), std::string(name_of(m.volume.from)), what});
    else
      rows.push_back({std::string(m.name), "-", "-", "-", "-", "-", "-", what});
  }
  print_table(rows);

  rows = {{"estimator", "gives", "paper"}};
  for (const Estimator& e : estimators())
    rows.push_back({std::string(e.name), std::string(e.gives), std::string(e.paper)});
  fmt::print("\n");
  print_table(rows);

  rows = {{"estimator of radiance", "gives", "paper"}};
  for (const RadianceEstimator& e : radiance_estimators())
    rows.push_back({std::string(e.name), std::string(e.gives), std::string(e.paper)});
  fmt::print("\n");
  print_table(rows);

  rows = {{"estimator in media", "gives", "paper"}};
  for (const VolumeEstimator& e : volume_estimators())
    rows.push_back({std::string(e.name), std::string(e.gives), std::string(e.paper)});
  fmt::print("\n");
  print_table(rows);

  rows = {{"metric", "needs", "paper"}};
  for (const Metric& m : metrics())
    rows.push_back({std::string(m.name),
                    m.needs > 1 ? "a Hessian"
                    : m.bounded ? "distances; a gradient for the gradient bound"
                                : "distances",
                    std::string(m.paper)});
  fmt::print("\n");
  print_table(rows);

  rows = {{"metric in media", "needs", "paper"}};
  for (const VolumeMetric& m : volume_metrics())
    rows.push_back({std::string(m.name),
                    m.needs_sums  ? "gradients of samples"
                    : m.needs > 1 ? "a Hessian"
                                  : "nothing",
                    std::string(m.paper)});
  fmt::print("\n");
  print_table(rows);
  return 0;
}

}  // namespace isophote::app
