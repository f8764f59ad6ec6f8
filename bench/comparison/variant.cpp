#include "comparison/variant.h"

#include "comparison/set_up.h"
#include "isophote/core/error.h"

namespace isophote::bench {
namespace {

void change(Method& method, const std::string& key, const std::string& value) {
  MetricSettings& settings = method.settings;
  if (key == "estimator")
    method.estimator = &find_estimator(value);
  else if (key == "order")
    method.order = std::stoi(value);
  else if (key == "aspect")
    settings.aspect = std::stof(value);
  else if (key == "neighbours")
    settings.bounds.neighbours = std::stof(value);
  else
    throw UsageError("a variant knows no '" + key + "'");
}

}  // namespace

Method variant(const std::string& text) {
  const std::vector<std::string> parts = split(text, '+');
  Method method = find_method(parts.front());
  method.secondary = Secondary::off, method.adaptive = false;  // gathers are shared
  method.volume = {};                                          // irradiance is what is compared
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t equals = std::min(parts[i].find('='), parts[i].size() - 1);
    change(method, parts[i].substr(0, equals), parts[i].substr(equals + 1));
  }
  check_combination(method);
  return method;
}

}  // namespace isophote::bench
