#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "comparison/occluded_plane.h"
#include "comparison/plane_figures.h"
#include "isophote/validity/total_error.h"

namespace isophote::bench {
namespace {

constexpr double line_y = 1.45, record_x = 0.72, begin = 0.1, end = 1.5;
constexpr double allowed = 1e-3;  // of total error, by which the line form decides a radius

/// The integral over [-reach, reach] of |f|, by the midpoint rule.
double total(const std::function<double(double)>& f, double reach) {
  constexpr int steps = 400;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += std::abs(f(reach * (2 * (i + 0.5) / steps - 1)));
  return sum * 2 * reach / steps;
}

}  // namespace

void print_line() {
  const OccludedPlane plane;
  const double value = plane.irradiance(record_x, line_y);
  const OccludedPlane::Derivatives d = plane.derivatives(record_x, line_y);
  const auto truth = [&](double t) { return plane.irradiance(record_x + t, line_y); };
  const auto first = [&](double t) { return value + d.gx * t; };
  const auto second = [&](double t) { return first(t) + d.hxx * t * t / 2; };
  fmt::print(
      "{{\"x\": {}, \"value\": {}, \"gradient\": {}, \"hessian\": {}, \"allowed\": {}, \"radius\": {},\n\"line\": [",
      record_x, value, d.gx, d.hxx, allowed, total_error_on_line(d.hxx, allowed));
  constexpr int samples = 200;
  for (int i = 0; i <= samples; ++i) {
    const double t = begin + (end - begin) * i / samples - record_x;
    fmt::print("{}[{}, {}, {}, {}]", i ? ", " : "", record_x + t, truth(t), first(t), second(t));
  }
  fmt::print("],\n\"total\": [");
  for (double reach = 0.02; reach < 0.6; reach *= 1.15)
    fmt::print("{}[{}, {}, {}, {}]", reach > 0.02 ? ", " : "", reach,
               total([&](double t) { return truth(t) - first(t); }, reach),
               total([&](double t) { return truth(t) - second(t); }, reach), std::abs(d.hxx) * std::pow(reach, 3) / 3);
  fmt::print("]}}\n");
}

}  // namespace isophote::bench
