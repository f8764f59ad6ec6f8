#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "isophote/validity/volume_record.h"

namespace isophote {

/// Finds, among many records, those that limit the unscaled radius of another and those that it limits: records that
/// face alike keep R_i <= R_j + slope |x_i - x_j| [Krivanek 2006]. An octree over their positions, whose cells know the
/// least and the greatest unscaled radius in them, so that few pairs are looked at. Ids count insertions. Records may
/// lie beyond the bounds. For one thread.
class NeighbourIndex {
 public:
  /// What it wants to know of a record.
  struct Known {
    Vec3 position, normal;
    float unscaled = 0;

    Known(const Site& site) : position(site.position), normal(site.normal), unscaled(site.footprint.unscaled) {}
    /// Records in media all face alike: radiance does not jump at the bounds of a medium.
    Known(const VolumeRecord& record) : Known(static_cast<const Site&>(record)) { normal = {0, 0, 1}; }
  };

  explicit NeighbourIndex(const Box& bounds);

  /// How many records it knows: those of ids below.
  std::size_t size() const { return known_.size(); }
  void insert(const Known& record);
  /// To be told when the unscaled radius of a known record was lowered.
  void lower(std::uint32_t id, float unscaled);

  /// The least of the record's unscaled radius and all R_j + slope |x_j - x| among the known records that face alike.
  float limit(const Known& record, float slope) const;
  /// The known records that `by` limits, in an order fixed by the insertions.
  std::vector<std::uint32_t> limited(const Known& by, float slope) const;

 private:
  struct Cell {
    Vec3 center;
    float half;
    Box box;  // of the positions
    float least = std::numeric_limits<float>::infinity(), greatest = 0;
    std::array<std::uint32_t, 8> children{};  // 0: none, for the root is nobody's child
    std::vector<std::uint32_t> ids;           // of a leaf
  };

  int octant(const Cell& cell, const Vec3& p) const;
  std::uint32_t child(std::uint32_t cell, int octant);
  void split(std::uint32_t cell);
  void insert(std::uint32_t cell, std::uint32_t id);
  void lower(std::uint32_t cell, const Vec3& position);
  void limit(std::uint32_t cell, const Known& record, float slope, float& least) const;
  void limited(std::uint32_t cell, const Known& by, float slope, std::vector<std::uint32_t>& found) const;

  std::vector<Known> known_;
  std::vector<Cell> cells_;
  float smallest_;
};

/// What `settle` changes: the records, of which the newest have not met the others, and the index of those that have.
template <class R>
struct SettlingOf {
  std::span<R> records;
  NeighbourIndex& neighbours;
};
using Settling = SettlingOf<Record>;

}  // namespace isophote
