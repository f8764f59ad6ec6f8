#include "isophote/validity/neighbour_index.h"

#include <algorithm>
#include <utility>

namespace isophote {
namespace {

constexpr std::size_t leaf_size = 16;

float distance_squared(const Box& box, const Vec3& p) {
  return length_squared(max(max(box.lower - p, p - box.upper), Vec3{}));
}

}  // namespace

NeighbourIndex::NeighbourIndex(const Box& bounds) : cells_(1) {
  cells_[0].center = bounds.empty() ? Vec3{} : bounds.center();
  cells_[0].half = bounds.empty() ? 1.0f : std::max(max_component(bounds.size()) * 0.5f, 1e-30f);
  smallest_ = cells_[0].half * 0x1p-20f;  // below that, floats no longer tell cells apart
}

int NeighbourIndex::octant(const Cell& cell, const Vec3& p) const {
  return (p.x > cell.center.x) | (p.y > cell.center.y) << 1 | (p.z > cell.center.z) << 2;
}

std::uint32_t NeighbourIndex::child(std::uint32_t cell, int octant) {
  if (cells_[cell].children[octant] == 0) {
    cells_[cell].children[octant] = static_cast<std::uint32_t>(cells_.size());
    const Vec3 c = cells_[cell].center;
    const float half = cells_[cell].half * 0.5f;
    Cell& made = cells_.emplace_back();
    made.center = {octant & 1 ? c.x + half : c.x - half, octant & 2 ? c.y + half : c.y - half,
                   octant & 4 ? c.z + half : c.z - half};
    made.half = half;
  }
  return cells_[cell].children[octant];
}

void NeighbourIndex::insert(std::span<const Record> records) {
  insert(records, 0, static_cast<std::uint32_t>(size_));
  ++size_;
}

void NeighbourIndex::insert(std::span<const Record> records, std::uint32_t cell, std::uint32_t id) {
  const Record& record = records[id];
  Cell& here = cells_[cell];
  here.box.extend(record.position);
  here.least = std::min(here.least, record.footprint.unscaled);
  here.greatest = std::max(here.greatest, record.footprint.unscaled);
  if (std::any_of(here.children.begin(), here.children.end(), [](std::uint32_t c) { return c != 0; })) {
    insert(records, child(cell, octant(here, record.position)), id);
    return;
  }
  here.ids.push_back(id);
  if (here.ids.size() > leaf_size && here.half > smallest_) split(records, cell);
}

void NeighbourIndex::split(std::span<const Record> records, std::uint32_t cell) {
  const std::vector<std::uint32_t> ids = std::exchange(cells_[cell].ids, {});
  for (const std::uint32_t id : ids) insert(records, child(cell, octant(cells_[cell], records[id].position)), id);
}

void NeighbourIndex::lowered(std::span<const Record> records, std::uint32_t id) {
  lowered(records, 0, records[id].position);
}

void NeighbourIndex::lowered(std::span<const Record> records, std::uint32_t cell, const Vec3& position) {
  Cell& here = cells_[cell];
  if (const std::uint32_t next = here.children[octant(here, position)]) lowered(records, next, position);
  here.greatest = 0;
  const auto take = [&](float least, float greatest) {
    here.least = std::min(here.least, least), here.greatest = std::max(here.greatest, greatest);
  };
  for (const std::uint32_t id : here.ids) take(records[id].footprint.unscaled, records[id].footprint.unscaled);
  for (const std::uint32_t next : here.children)
    if (next != 0) take(cells_[next].least, cells_[next].greatest);
}

float NeighbourIndex::limit(std::span<const Record> records, const Vec3& position, const Vec3& normal, float unscaled,
                            float slope) const {
  limit(records, 0, position, normal, slope, unscaled);
  return unscaled;
}

void NeighbourIndex::limit(std::span<const Record> records, std::uint32_t cell, const Vec3& position,
                           const Vec3& normal, float slope, float& least) const {
  const Cell& here = cells_[cell];
  const auto in_reach = [&](float radius, float distance_squared) {
    const float reach = (least - radius) / slope;
    return reach > 0 && distance_squared < reach * reach;
  };
  if (!in_reach(here.least, distance_squared(here.box, position))) return;
  for (const std::uint32_t id : here.ids) {
    const Record& other = records[id];
    const float apart = length_squared(other.position - position);
    if (in_reach(other.footprint.unscaled, apart) && dot(normal, other.normal) > 0)
      least = std::min(least, other.footprint.unscaled + slope * std::sqrt(apart));
  }
  const int nearest = octant(here, position);
  for (int i = 0; i < 8; ++i)
    if (const std::uint32_t next = here.children[nearest ^ i]) limit(records, next, position, normal, slope, least);
}

std::vector<std::uint32_t> NeighbourIndex::limited(std::span<const Record> records, const Record& by,
                                                   float slope) const {
  std::vector<std::uint32_t> found;
  limited(records, 0, by, slope, found);
  return found;
}

void NeighbourIndex::limited(std::span<const Record> records, std::uint32_t cell, const Record& by, float slope,
                             std::vector<std::uint32_t>& found) const {
  const Cell& here = cells_[cell];
  const auto in_reach = [&](float radius, float distance_squared) {
    const float reach = (radius - by.footprint.unscaled) / slope;
    return reach > 0 && distance_squared < reach * reach;
  };
  if (!in_reach(here.greatest, distance_squared(here.box, by.position))) return;
  for (const std::uint32_t id : here.ids) {
    const Record& other = records[id];
    if (in_reach(other.footprint.unscaled, length_squared(other.position - by.position)) &&
        dot(by.normal, other.normal) > 0)
      found.push_back(id);
  }
  for (const std::uint32_t next : here.children)
    if (next != 0) limited(records, next, by, slope, found);
}

}  // namespace isophote
