#include "isophote/trace/density_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "isophote/scene/density_grid.h"

namespace isophote {
namespace {

float at_height(const HeightDensity& d, float y) { return std::exp((d.base - y) / d.height); }

FlightEnd fly_uniform(float from, float to, float amount) {
  const float distance = from + amount;
  return distance < to ? FlightEnd{distance, 1} : FlightEnd{};
}

/// The logarithm of density along a ray is start - slope t: far above the fog density itself would be 0.
struct HeightLine {
  double start, slope;

  HeightLine(const HeightDensity& d, const Ray& ray, float from)
      : start((d.base - (ray.origin.y + static_cast<double>(from) * ray.direction.y)) / d.height),
        slope(static_cast<double>(ray.direction.y) / d.height) {}
};

// Up to t the column is (1 - exp(-slope t)) exp(start) / slope: t = -log(1 - slope amount exp(-start)) / slope.
FlightEnd fly_through_height(const HeightDensity& d, const Ray& ray, float from, float to, float amount) {
  constexpr double large = 600;  // whose exponential is near to infinity
  const auto [start, slope] = HeightLine(d, ray, from);
  const double turn = slope * amount, ratio = turn * std::exp(-start);
  if (!(ratio < 1)) return {};
  double way = amount * std::exp(-start);
  if (slope < 0 && -start > large && amount > 0)
    way = (start - std::log(-turn)) / slope;
  else if (std::abs(ratio) > 1e-6)
    way = -std::log1p(-ratio) / slope;
  const auto distance = static_cast<float>(from + way);
  const float bound = at_height(d, ray.origin.y + distance * ray.direction.y);
  return distance < to && bound > 0 ? FlightEnd{distance, bound} : FlightEnd{};
}

/// Visits the cubes of `size` into which a grid is cut that a ray crosses, from `from` on, in its own parameter.
class CubeWalk {
 public:
  CubeWalk(const DensityGrid& grid, const Ray& ray, float from, int size) {
    const Vec3d origin = grid.to_grid(Vec3d(ray.origin)) / static_cast<double>(size);
    const Vec3d direction = grid.direction_to_grid(Vec3d(ray.direction)) / static_cast<double>(size);
    for (int i = 0; i < 3; ++i) {
      const double here = origin[i] + from * direction[i];
      cell_[i] = static_cast<int>(std::floor(here));
      step_[i] = direction[i] < 0 ? -1 : 1;
      each_[i] = direction[i] != 0 ? 1 / std::abs(direction[i]) : infinity;
      const double border = cell_[i] + (step_[i] > 0 ? 1 : 0);
      next_[i] = direction[i] != 0 ? (border - origin[i]) / direction[i] : infinity;
    }
  }
  int cell(int i) const { return cell_[i]; }
  /// Where the ray leaves the present cube.
  double end() const { return next_[nearest()]; }
  void advance() {
    const int i = nearest();
    cell_[i] += step_[i];
    next_[i] += each_[i];
  }

 private:
  int nearest() const { return next_[0] < next_[1] ? (next_[0] < next_[2] ? 0 : 2) : (next_[1] < next_[2] ? 1 : 2); }
  int cell_[3], step_[3];
  double each_[3], next_[3];
};

FlightEnd fly_through_grid(const DensityGrid& grid, const Ray& ray, float from, float to, float amount) {
  double here = from, left = amount;
  for (CubeWalk walk(grid, ray, from, DensityGrid::block); here < to; walk.advance()) {
    const double end = std::min(walk.end(), static_cast<double>(to));
    const float bound = grid.block_majorant(walk.cell(0), walk.cell(1), walk.cell(2));
    const double passed = (end - here) * bound;
    if (passed > left) return {static_cast<float>(here + left / bound), bound};
    left -= std::max(passed, 0.0);
    here = std::max(here, end);
  }
  return {};
}

Columns uniform_columns(float from, float to) { return {static_cast<double>(to) - from, {}, {}}; }

/// int_0^1 exp(-k u) du and int_0^1 u exp(-k u) du, k not below 0.
std::array<double, 2> exponential_moments(double k) {
  if (k < 1e-3) return {1 - k / 2 + k * k / 6, 0.5 - k / 3 + k * k / 8};
  const double e = std::exp(-k);
  return {-std::expm1(-k) / k, (1 - e * (1 + k)) / (k * k)};
}

Columns height_columns(const HeightDensity& d, const Ray& ray, float from, float to) {
  const HeightLine line(d, ray, from);
  const double size = static_cast<double>(to) - from, decay = line.slope * size;
  const auto [m0, m1] = exponential_moments(std::abs(decay));  // from the end where it is denser
  const double lower = std::exp(line.start - std::min(decay, 0.0)) * size;
  const double column = lower * m0, moment = from * column + lower * size * (decay < 0 ? m0 - m1 : m1);
  return {column, {0, -column / d.height, 0}, {0, -moment / d.height, 0}};
}

// Along a ray through a cell a trilinear density is a cubic, and its gradient at most quadratic: times s, three points
// of Gauss integrate all of them.
Columns grid_columns(const DensityGrid& grid, const Ray& ray, float from, float to) {
  static constexpr double nodes[] = {0.11270166537925831, 0.5, 0.88729833462074169};
  static constexpr double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  Columns sum;
  double here = from;
  for (CubeWalk walk(grid, ray, from, 1); here < to; walk.advance()) {
    const double end = std::min(walk.end(), static_cast<double>(to));
    const double size = end - here;
    for (int i = 0; size > 0 && i < 3; ++i) {
      const double s = here + size * nodes[i], weight = size * weights[i];
      const Vec3 p(Vec3d(ray.origin) + Vec3d(ray.direction) * s);
      const Vec3d gradient = Vec3d(grid.gradient(p)) * weight;
      sum += {grid.density(p) * weight, gradient, gradient * s};
    }
    here = std::max(here, end);
  }
  return sum;
}

}  // namespace

Columns columns(const Medium& medium, const Ray& ray, float from, float to) {
  if (const auto* height = std::get_if<HeightDensity>(&medium.density)) return height_columns(*height, ray, from, to);
  if (const auto* grid = std::get_if<GridDensity>(&medium.density)) return grid_columns(**grid, ray, from, to);
  return uniform_columns(from, to);
}

Box box_about(const Medium& medium) {
  if (const auto* box = std::get_if<Box>(&medium.bounds)) return *box;
  Box box;
  for (const Vec3& p : std::get<ClosedMesh>(medium.bounds).positions) box.extend(p);
  return box;
}

float largest_density(const Medium& medium) {
  if (const auto* grid = std::get_if<GridDensity>(&medium.density)) return (*grid)->majorant();
  return density_at(medium, box_about(medium).lower);  // height fog thins upwards
}

float density_at(const Medium& medium, const Vec3& p) {
  if (const auto* height = std::get_if<HeightDensity>(&medium.density)) return at_height(*height, p.y);
  if (const auto* grid = std::get_if<GridDensity>(&medium.density)) return (*grid)->density(p);
  return 1;
}

FlightEnd fly(const Medium& medium, const Ray& ray, float from, float to, float amount) {
  if (const auto* height = std::get_if<HeightDensity>(&medium.density))
    return fly_through_height(*height, ray, from, to, amount);
  if (const auto* grid = std::get_if<GridDensity>(&medium.density))
    return fly_through_grid(**grid, ray, from, to, amount);
  return fly_uniform(from, to, amount);
}

}  // namespace isophote
