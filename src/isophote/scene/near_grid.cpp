#include "isophote/scene/near_grid.h"

#include <algorithm>
#include <bit>

namespace isophote {

NearGrid::NearGrid(const Box& bounds, const std::vector<Place>& places) {
  if (places.empty() || bounds.empty() || !(bounds.diagonal() > 0)) return;
  lower_ = bounds.lower;
  const float least = bounds.diagonal() / side;  // a flat box is one cell thick
  for (int axis = 0; axis < 3; ++axis) cell_size_[axis] = std::max(bounds.size()[axis], least) / side;

  // In how many boxes each cell is, as differences along all three axes: a box is a change at its eight corners.
  constexpr std::size_t step_y = side + 1, step_z = step_y * (side + 1), count = step_z * (side + 1);
  std::vector<std::int32_t> boxes(count);
  for (const Place& place : places) {
    std::size_t from[3], to[3];
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = cell(place.box.lower[axis] - place.distance, axis);
      to[axis] = cell(place.box.upper[axis] + place.distance, axis) + 1;
    }
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t x = corner & 1 ? to[0] : from[0], y = corner & 2 ? to[1] : from[1],
                        z = corner & 4 ? to[2] : from[2];
      boxes[z * step_z + y * step_y + x] += std::popcount(static_cast<unsigned>(corner)) % 2 == 0 ? 1 : -1;
    }
  }
  // A sum may run on into the next row or layer: what it brings there is 0, as each box has ended before.
  for (const std::size_t step : {std::size_t{1}, step_y, step_z})
    for (std::size_t i = step; i < count; ++i) boxes[i] += boxes[i - step];
  marks_.resize(static_cast<std::size_t>(side) * side * side);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) marks_[index(x, y, z)] = boxes[z * step_z + y * step_y + x] > 0;
}

int NearGrid::cell(float x, int axis) const {
  // Clamped before it is rounded: a reach may be larger than an int counts.
  return static_cast<int>(std::clamp((x - lower_[axis]) / cell_size_[axis], 0.0f, static_cast<float>(side - 1)));
}

bool NearGrid::marked(const Vec3& p) const {
  return !marks_.empty() && marks_[index(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2))] != 0;
}

}  // namespace isophote
