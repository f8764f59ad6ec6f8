#include "isophote/sampling/distribution.h"

#include <algorithm>
#include <cmath>
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
  const float* above = std::upper_bound(cumulative + 1, cumulative + count + 1, u);
  const int i = std::min(static_cast<int>(above - cumulative) - 1, count - 1);
  const float fraction = (u - cumulative[i]) / (cumulative[i + 1] - cumulative[i]);
  return {i, std::min(fraction, 0x1.fffffep-1f)};
}

/// Writes count + 1 cumulative values and returns the sum of the weights; where that is 0, the values are 0.
double accumulate(const auto& weight, int count, float* cumulative) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += weight(i);
  double running = 0;
  cumulative[0] = 0;
  for (int i = 0; i < count; ++i) {
    running += weight(i);
    cumulative[i + 1] = sum > 0 ? static_cast<float>(running / sum) : 0.0f;
  }
  return sum;
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
  const std::uint64_t x = static_cast<std::uint64_t>(u * static_cast<float>(grid)) * entries_.size();
  const auto slot = static_cast<std::uint32_t>(x / grid);
  return x % grid < entries_[slot].threshold ? slot : entries_[slot].alias;
}

Distribution2D::Distribution2D(std::span<const float> weights, int width, int height) : width_(width), height_(height) {
  ISOPHOTE_CHECK(weights.size(), ==, static_cast<std::size_t>(width) * height);
  rows_.resize(static_cast<std::size_t>(height) + 1);
  columns_.resize((static_cast<std::size_t>(width) + 1) * height);
  std::vector<double> sums(height);
  for (int y = 0; y < height; ++y) {
    const float* row = weights.data() + static_cast<std::size_t>(y) * width;
    float* cumulative = columns_.data() + static_cast<std::size_t>(y) * (width + 1);
    sums[y] = accumulate([&](int x) { return static_cast<double>(row[x]); }, width, cumulative);
  }
  if (accumulate([&](int y) { return sums[y]; }, height, rows_.data()) > 0) return;
  rows_.clear();
  columns_.clear();
}

Vec2 Distribution2D::sample(Vec2 u) const {
  const auto [y, fy] = invert(rows_.data(), height_, u.y);
  const auto [x, fx] = invert(columns_.data() + static_cast<std::size_t>(y) * (width_ + 1), width_, u.x);
  // The quotient may round up to the next cell; the point belongs to this one.
  const float px = std::min((x + fx) / width_, std::nextafter((x + 1.0f) / width_, 0.0f));
  const float py = std::min((y + fy) / height_, std::nextafter((y + 1.0f) / height_, 0.0f));
  return {px, py};
}

float Distribution2D::pdf(Vec2 p) const {
  const int x = std::clamp(static_cast<int>(p.x * width_), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(p.y * height_), 0, height_ - 1);
  const float* columns = columns_.data() + static_cast<std::size_t>(y) * (width_ + 1) + x;
  return (rows_[y + 1] - rows_[y]) * (columns[1] - columns[0]) * (static_cast<float>(width_) * height_);
}

}  // namespace isophote
