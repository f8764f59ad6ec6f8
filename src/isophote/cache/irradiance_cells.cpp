#include "isophote/cache/irradiance_cells.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/hash.h"

namespace isophote {
namespace {

/// Cells are as long as this part of the way that a ray has come, or up to twice as long, within limits: powers of two
/// of the scene's diagonal.
constexpr float of_way = 0.3f;
constexpr int finest = 9, coarsest = 5;
constexpr int bits = 10;  // of a coordinate: one more than the finest grid needs
constexpr int level_at = 3 * bits;

}  // namespace

IrradianceCells::IrradianceCells(const Box& bounds)
    : lower_(bounds.empty() ? Vec3{} : bounds.lower), diagonal_(bounds.empty() ? 1 : bounds.diagonal()) {}

std::uint64_t IrradianceCells::key(const Vec3& position, const Vec3& normal, float distance) const {
  int exponent = 0;
  std::frexp(of_way * distance / diagonal_, &exponent);
  const int level = std::isfinite(distance) ? std::clamp(-exponent, coarsest, finest) : coarsest;
  const Vec3 p = (position - lower_) * (std::ldexp(1.0f, level) / diagonal_);
  const auto coordinate = [](float x) {
    constexpr float most = (1 << bits) - 1;
    return static_cast<std::uint64_t>(std::clamp(x + 1, 0.0f, most));  // rounding may have left the box
  };
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  const int side = 2 * axis + (normal[axis] < 0);
  return static_cast<std::uint64_t>(side * 16 + level) << level_at | coordinate(p.x) << 2 * bits |
         coordinate(p.y) << bits | coordinate(p.z);
}

float IrradianceCells::edge(std::uint64_t key) const {
  return std::ldexp(diagonal_, -static_cast<int>(key >> level_at & 15));
}

void IrradianceCells::clear() {
  cells_.clear();
  std::fill(table_.begin(), table_.end(), 0);
}

std::size_t IrradianceCells::slot(std::uint64_t key) const {
  std::size_t i = hash(key) & (table_.size() - 1);
  while (table_[i] != 0 && cells_[table_[i] - 1].key != key) i = (i + 1) & (table_.size() - 1);
  return i;
}

const IrradianceCells::Cell* IrradianceCells::find(std::uint64_t key) const {
  if (table_.empty()) return nullptr;
  const std::uint32_t found = table_[slot(key)];
  return found == 0 ? nullptr : &cells_[found - 1];
}

void IrradianceCells::grow() {
  table_.assign(std::max<std::size_t>(64, 2 * table_.size()), 0);
  for (std::size_t i = 0; i < cells_.size(); ++i) table_[slot(cells_[i].key)] = static_cast<std::uint32_t>(i + 1);
}

void IrradianceCells::add(const Cell& more) {
  if (cells_.size() < most_cells && 2 * (cells_.size() + 1) > table_.size()) grow();
  const std::size_t at = slot(more.key);
  if (table_[at] == 0) {
    if (cells_.size() == most_cells) return;
    cells_.push_back(more);
    table_[at] = static_cast<std::uint32_t>(cells_.size());
    return;
  }
  Cell& cell = cells_[table_[at] - 1];
  cell.sum += more.sum;
  cell.weight += more.weight;
  cell.count += more.count;
  cell.nearest = std::min(cell.nearest, more.nearest);
  cell.cut = cell.cut || more.cut;
}

}  // namespace isophote
