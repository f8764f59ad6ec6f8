#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "isophote/cache/octree.h"
#include "isophote/cache/record_cache.h"

namespace isophote {

/// Finds the records from which one may learn: near, on the same surface, and with nothing in between.
template <class R>
class RecordNeighbours {
 public:
  struct Neighbour {
    const R* record;
    Vec3 offset;     ///< from the one that asks
    float distance;  ///< its length
  };

  /// Of all records of a cache as they are, which must stay so; each is a neighbour up to `radii` of its own away.
  RecordNeighbours(const RecordStore<R>& cache, float radii)
      : records_(cache.records()), radii_(radii), reach_(cache.bounds()) {
    for (std::uint32_t id = 0; id < records_.size(); ++id)
      reach_.insert(id, records_[id].position, radii * records_[id].footprint.radius);
  }

  std::span<const R> records() const { return records_; }

  /// The record itself among them. Those that `open` finds hidden are left out. Any thread may ask.
  std::vector<Neighbour> around(const R& record, OpenTest open) const {
    constexpr float alike = 0.95f, off_plane = 0.15f;
    const auto free = [&](const R& from, const R& to) {
      return !from.jet.distances.obstacles.before(to.position - from.position, from.normal) ||
             open(from, {to.position, to.normal, to.normal});
    };
    std::vector<Neighbour> found;
    reach_.any(record.position, [&](std::uint32_t id) {
      const R& other = records_[id];
      const Vec3 q = other.position - record.position;
      const float distance = length(q);
      const float reach = radii_ * std::min(record.footprint.radius, other.footprint.radius);
      if (distance > reach || dot(other.normal, record.normal) < alike) return false;
      if (std::max(std::abs(dot(q, record.normal)), std::abs(dot(q, other.normal))) > off_plane * distance)
        return false;
      if (free(record, other) && free(other, record)) found.push_back({&other, q, distance});
      return false;
    });
    return found;
  }

 private:
  std::span<const R> records_;
  float radii_;
  Octree reach_;
};

}  // namespace isophote
