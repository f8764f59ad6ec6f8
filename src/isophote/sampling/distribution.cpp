#include "isophote/sampling/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "isophote/core/check.h"

namespace isophote {
namespace {

// Random numbers are multiples of 2^-24 (unit_float). The alias table works on that grid with integers, so that
// `probability` is what `sample` really does, however many entries there are.
constexpr std::uint64_t grid = 1u << 24;

/// The first grid point k with k count >= x.
std::uint64_t first_at_least(std::uint64_t x, std::uint64_t count) { return (x + count - 1) / count; }

/// Index i with cumulative[i] <= u < cumulative[i + 1], and where u lies between the two.
struct Place {
  int index;
  float fraction;
};
Place invert(const float* cumulative, int count, float u) {
  const float* above = std::upper_bound(cumulative + 1, cumulative + count, u);
  const auto i = static_cast<int>(above - cumulative) - 1;
  // From the middle of the step that u stands for: a cell may be as narrow as one.
  constexpr float half_step = 0.5f / grid;
  return {i, (u - cumulative[i] + half_step) / (cumulative[i + 1] - cumulative[i])};
}

/// The cell, of `count`, that a coordinate of the unit interval lies in.
int cell(float coordinate, int count) {
  const auto n = static_cast<float>(count);
  return static_cast<int>(std::min(n - 1, std::max(0.0f, coordinate * n)));
}

/// The coordinate at a fraction of a cell, one below 1 that lies in this cell however it rounds.
float coordinate(const Place& place, int count) {
  float p = std::min((static_cast<float>(place.index) + place.fraction) / static_cast<float>(count), 0x1.fffffep-1f);
  while (cell(p, count) > place.index) p = std::nextafter(p, 0.0f);
  while (cell(p, count) < place.index) p = std::nextafter(p, 1.0f);
  return p;
}

/// Writes count + 1 cumulative values, multiples of 2^-24; the sum of the weights is not 0.
void accumulate(const auto& weight, int count, float* cumulative) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += weight(i);
  const double scale = grid / sum;
  double running = 0;
  cumulative[0] = 0;
  for (int i = 0; i < count; ++i) {
    running += weight(i);
    cumulative[i + 1] = static_cast<float>(static_cast<std::int32_t>(running * scale + 0.5)) / grid;
  }
}

}  // namespace

AliasTable::AliasTable(std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) return;
  ISOPHOTE_CHECK(weights.size(), <=, grid);
  const auto count = static_cast<std::uint32_t>(weights.size());
  entries_.resize(count);

  std::vector<double> share(count);  // of a slot; 1 fills it
  std::vector<std::uint32_t> under, over;
  for (std::uint32_t i = 0; i < count; ++i) {
    share[i] = weights[i] / sum * count;
    (share[i] < 1 ? under : over).push_back(i);
  }
  while (!under.empty() && !over.empty()) {
    const std::uint32_t small = under.back(), large = over.back();
    under.pop_back();
    entries_[small] = {static_cast<std::uint32_t>(std::lround(share[small] * grid)), large, 0};
    share[large] -= 1 - share[small];
    if (share[large] < 1) over.pop_back(), under.push_back(large);
  }
  for (const auto& rest : {under, over})  // 1 but for rounding
    for (const std::uint32_t i : rest) entries_[i] = {static_cast<std::uint32_t>(grid), i, 0};

  std::vector<std::uint64_t> points(count, 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t begin = first_at_least(i * grid, count), end = first_at_least((i + 1) * grid, count);
    const std::uint64_t split = first_at_least(i * grid + entries_[i].threshold, count);
    points[i] += split - begin;
    points[entries_[i].alias] += end - split;
  }
  for (std::uint32_t i = 0; i < count; ++i)
    entries_[i].probability = static_cast<float>(static_cast<double>(points[i]) / grid);
}

std::uint32_t AliasTable::sample(float u) const {
  ISOPHOTE_CHECK(entries_.size(), >, 0u);
  const std::uint64_t x = static_cast<std::uint64_t>(u * static_cast<float>(grid)) * entries_.size();
  const auto slot = static_cast<std::uint32_t>(x / grid);
  return x % grid < entries_[slot].threshold ? slot : entries_[slot].alias;
}

Distribution2D::Distribution2D(std::span<const float> weights, int width, int height) : width_(width), height_(height) {
  ISOPHOTE_CHECK(weights.size(), ==, static_cast<std::size_t>(width) * height);
  std::vector<double> sums(height);
  for (int y = 0; y < height; ++y) {
    const auto row = weights.subspan(static_cast<std::size_t>(y) * width, width);
    sums[y] = std::accumulate(row.begin(), row.end(), 0.0);
  }
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  ISOPHOTE_CHECK(sum, <, std::numeric_limits<double>::infinity());  // nor is it NaN
  if (sum == 0) return;

  cumulative_rows_.resize(static_cast<std::size_t>(height) + 1);
  accumulate([&](int y) { return sums[y]; }, height, cumulative_rows_.data());
  stored_row_.resize(height);
  std::uint32_t stored = 0;
  for (int y = 0; y < height; ++y)
    if (cumulative_rows_[y + 1] > cumulative_rows_[y]) stored_row_[y] = stored++;
  cumulative_columns_.resize((static_cast<std::size_t>(width) + 1) * stored);
  for (int y = 0; y < height; ++y) {
    if (!(cumulative_rows_[y + 1] > cumulative_rows_[y])) continue;
    const float* row = weights.data() + static_cast<std::size_t>(y) * width;
    accumulate([&](int x) { return static_cast<double>(row[x]); }, width,
               cumulative_columns_.data() + static_cast<std::size_t>(stored_row_[y]) * (width + 1));
  }
}

Vec2 Distribution2D::sample(Vec2 u) const {
  ISOPHOTE_CHECK(cumulative_rows_.size(), >, 0u);
  const Place row = invert(cumulative_rows_.data(), height_, u.y);
  const Place column = invert(columns(row.index), width_, u.x);
  return {coordinate(column, width_), coordinate(row, height_)};
}

float Distribution2D::probability(int x, int y) const {
  const float row = cumulative_rows_[y + 1] - cumulative_rows_[y];
  if (!(row > 0)) return 0;
  const float* cumulative = columns(y) + x;
  return row * (cumulative[1] - cumulative[0]);
}

float Distribution2D::pdf(Vec2 p) const {
  return probability(cell(p.x, width_), cell(p.y, height_)) * (static_cast<float>(width_) * height_);
}

}  // namespace isophote
