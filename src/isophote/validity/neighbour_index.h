#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "isophote/validity/record.h"

namespace isophote {

/// Finds, among many records, those that limit the unscaled radius of another and those that it limits: records that
/// face alike keep R_i <= R_j + slope |x_i - x_j| [Krivanek 2006]. An octree over their positions, whose cells know the
/// least and the greatest unscaled radius in them, so that few pairs are looked at. It holds ids; the records are
/// handed in with each call, ids being their places. Records may lie beyond the bounds. For one thread.
class NeighbourIndex {
 public:
  explicit NeighbourIndex(const Box& bounds);

  /// How many records it knows: those of ids below.
  std::size_t size() const { return size_; }
  /// Takes in records[size()].
  void insert(std::span<const Record> records);
  /// To be told when the unscaled radius of a known record was lowered.
  void lowered(std::span<const Record> records, std::uint32_t id);

  /// The least of `unscaled` and all R_j + slope |x_j - position| among the known records that face as `normal` does.
  float limit(std::span<const Record> records, const Vec3& position, const Vec3& normal, float unscaled,
              float slope) const;
  /// The known records that `by` limits, in an order fixed by the insertions.
  std::vector<std::uint32_t> limited(std::span<const Record> records, const Record& by, float slope) const;

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
  void split(std::span<const Record> records, std::uint32_t cell);
  void insert(std::span<const Record> records, std::uint32_t cell, std::uint32_t id);
  void lowered(std::span<const Record> records, std::uint32_t cell, const Vec3& position);
  void limit(std::span<const Record> records, std::uint32_t cell, const Vec3& position, const Vec3& normal, float slope,
             float& least) const;
  void limited(std::span<const Record> records, std::uint32_t cell, const Record& by, float slope,
               std::vector<std::uint32_t>& found) const;

  std::vector<Cell> cells_;
  float smallest_;
  std::size_t size_ = 0;
};

/// What `settle` changes: the records, of which the newest have not met the others, and the index of those that have.
struct Settling {
  std::span<Record> records;
  NeighbourIndex& neighbours;
};

}  // namespace isophote
