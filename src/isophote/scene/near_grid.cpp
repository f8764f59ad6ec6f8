#include "isophote/scene/near_grid.h"

#include <algorithm>

namespace isophote {
namespace {

struct Cells {
  int first[3], last[3];
  void for_each_row(const auto& visit) const {
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y) visit(first[0], last[0], y, z);
  }
};

}  // namespace

NearGrid::NearGrid(const Box& bounds, const std::vector<Place>& places) {
  if (places.empty() || bounds.empty() || !(bounds.diagonal() > 0)) return;
  lower_ = bounds.lower;
  const float least = bounds.diagonal() / side;  // a flat box is one cell thick
  for (int axis = 0; axis < 3; ++axis) cell_size_[axis] = std::max(bounds.size()[axis], least) / side;
  const auto around = [&](const Box& box, float distance) {
    Cells cells;
    for (int axis = 0; axis < 3; ++axis) {
      cells.first[axis] = cell(box.lower[axis] - distance, axis);
      cells.last[axis] = cell(box.upper[axis] + distance, axis);
    }
    return cells;
  };

  // First the furthest reach from each cell, then what is reached: the places may be many and all reach far.
  std::vector<float> reach(static_cast<std::size_t>(side) * side * side, -1.0f);
  for (const Place& place : places)
    around(place.box, 0).for_each_row([&](int x0, int x1, int y, int z) {
      for (int x = x0; x <= x1; ++x) reach[index(x, y, z)] = std::max(reach[index(x, y, z)], place.distance);
    });
  marks_.resize(reach.size());
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float distance = reach[index(x, y, z)];
        if (distance < 0) continue;
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
        const Vec3 low = lower_ + Vec3{fx * cell_size_.x, fy * cell_size_.y, fz * cell_size_.z};
        around({low, low + cell_size_}, distance).for_each_row([&](int x0, int x1, int row, int layer) {
          std::fill(marks_.begin() + index(x0, row, layer), marks_.begin() + index(x1, row, layer) + 1,
                    std::uint8_t{1});
        });
      }
}

int NearGrid::cell(float x, int axis) const {
  // Clamped before it is rounded: a reach may be larger than an int counts.
  return static_cast<int>(std::clamp((x - lower_[axis]) / cell_size_[axis], 0.0f, static_cast<float>(side - 1)));
}

bool NearGrid::marked(const Vec3& p) const {
  return !marks_.empty() && marks_[index(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2))] != 0;
}

}  // namespace isophote
