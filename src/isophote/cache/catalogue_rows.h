#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "isophote/cache/catalogue.h"
#include "isophote/core/error.h"

// What the tables of the catalogue have in common.
namespace isophote {

/// The row of a name. Throws UsageError with the known names where there is none.
template <class Table>
const auto& find_row(const Table& table, std::string_view name, const char* kind) {
  std::string known;
  for (const auto& entry : table) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("unknown " + std::string(kind) + " '" + std::string(name) + "'; there are: " + known);
}

/// The threshold by which a metric of any kind aims at a wanted mean relative error.
template <class M>
float threshold_of(const M& metric, double error) {
  return std::min(greatest_threshold, metric.a_factor * std::pow(static_cast<float>(error), metric.a_power));
}

}  // namespace isophote
