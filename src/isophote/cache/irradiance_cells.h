#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isophote/core/ray.h"
#include "isophote/core/rgb.h"
#include "isophote/core/vec.h"

namespace isophote {

/// Means of irradiance samples over the cells of grids, each with cells half as large as the one before: what gathers
/// read, and leave, where their rays hit. A cell is of surfaces that face the same way along the same axis. Reading is
/// safe from any number of threads while nobody adds.
class IrradianceCells {
 public:
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t count = 0;    ///< of samples
    float weight = 0;           ///< of all of them
    Rgb sum{};                  ///< of their irradiances, W/m2, times their weights
    float nearest = infinity;   ///< what any of them saw
    Vec3 position{}, normal{};  ///< of the first: the others were found to lie in the open towards it
    bool cut = false;           ///< something was found between that and another point of the cell
  };

  /// Of the scene that lies within; without bounds, those of another are only kept.
  IrradianceCells() : IrradianceCells(Box{}) {}
  explicit IrradianceCells(const Box& bounds);

  /// The cell for a point that a ray hits after `distance`: the farther, the larger.
  std::uint64_t key(const Vec3& position, const Vec3& normal, float distance) const;
  /// The edge of a cell, scene units.
  float edge(std::uint64_t key) const;

  /// Null where there is none.
  const Cell* find(std::uint64_t key) const;
  /// Adds the samples of `more` to its cell. No more than `most_cells` are kept: what would be another is dropped.
  void add(const Cell& more);
  /// Forgets all cells, not their memory.
  void clear();
  /// In the order of their first samples.
  std::span<const Cell> cells() const { return cells_; }

  static constexpr std::size_t most_cells = std::size_t{1} << 20;

 private:
  std::size_t slot(std::uint64_t key) const;
  void grow();

  Vec3 lower_;
  float diagonal_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> table_;  // 1 + place in cells_; 0: free
};

}  // namespace isophote
