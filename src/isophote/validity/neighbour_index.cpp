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

void NeighbourIndex::insert(const Known& record) {
  known_.push_back(record);
  insert(0, static_cast<std::uint32_t>(known_.size() - 1));
}

void NeighbourIndex::insert(std::uint32_t cell, std::uint32_t id) {
  const Known& record = known_[id];
  Cell& here = cells_[cell];
  here.box.extend(record.position);
  here.least = std::min(here.least, record.unscaled);
  here.greatest = std::max(here.greatest, record.unscaled);
  if (std::any_of(here.children.begin(), here.children.end(), [](std::uint32_t c) { return c != 0; })) {
    insert(child(cell, octant(here, record.position)), id);
    return;
  }
  here.ids.push_back(id);
  if (here.ids.size() > leaf_size && here.half > smallest_) split(cell);
}

void NeighbourIndex::split(std::uint32_t cell) {
  const std::vector<std::uint32_t> ids = std::exchange(cells_[cell].ids, {});
  for (const std::uint32_t id : ids) insert(child(cell, octant(cells_[cell], known_[id].position)), id);
}

void NeighbourIndex::lower(std::uint32_t id, float unscaled) {
  known_[id].unscaled = unscaled;
  lower(0, known_[id].position);
}

void NeighbourIndex::lower(std::uint32_t cell, const Vec3& position) {
  Cell& here = cells_[cell];
  if (const std::uint32_t next = here.children[octant(here, position)]) lower(next, position);
  here.greatest = 0;
  const auto take = [&](float least, float greatest) {
    here.least = std::min(here.least, least), here.greatest = std::max(here.greatest, greatest);
  };
  for (const std::uint32_t id : here.ids) take(known_[id].unscaled, known_[id].unscaled);
  for (const std::uint32_t next : here.children)
    if (next != 0) take(cells_[next].least, cells_[next].greatest);
}

float NeighbourIndex::limit(const Known& record, float slope) const {
  float least = record.unscaled;
  limit(0, record, slope, least);
  return least;
}

void NeighbourIndex::limit(std::uint32_t cell, const Known& record, float slope, float& least) const {
  const Cell& here = cells_[cell];
  const auto in_reach = [&](float radius, float distance_squared) {
    const float reach = (least - radius) / slope;
    return reach > 0 && distance_squared < reach * reach;
  };
  if (!in_reach(here.least, distance_squared(here.box, record.position))) return;
  for (const std::uint32_t id : here.ids) {
    const Known& other = known_[id];
    const float apart = length_squared(other.position - record.position);
    if (in_reach(other.unscaled, apart) && dot(record.normal, other.normal) > 0)
      least = std::min(least, other.unscaled + slope * std::sqrt(apart));
  }
  const int nearest = octant(here, record.position);
  for (int i = 0; i < 8; ++i)
    if (const std::uint32_t next = here.children[nearest ^ i]) limit(next, record, slope, least);
}

std::vector<std::uint32_t> NeighbourIndex::limited(const Known& by, float slope) const {
  std::vector<std::uint32_t> found;
  limited(0, by, slope, found);
  return found;
}

void NeighbourIndex::limited(std::uint32_t cell, const Known& by, float slope,
                             std::vector<std::uint32_t>& found) const {
  const Cell& here = cells_[cell];
  const auto in_reach = [&](float radius, float distance_squared) {
    const float reach = (radius - by.unscaled) / slope;
    return reach > 0 && distance_squared < reach * reach;
  };
  if (!in_reach(here.greatest, distance_squared(here.box, by.position))) return;
  for (const std::uint32_t id : here.ids) {
    const Known& other = known_[id];
    if (in_reach(other.unscaled, length_squared(other.position - by.position)) && dot(by.normal, other.normal) > 0)
      found.push_back(id);
  }
  for (const std::uint32_t next : here.children)
    if (next != 0) limited(next, by, slope, found);
}

}  // namespace isophote
