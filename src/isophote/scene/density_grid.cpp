#include "isophote/scene/density_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/core/ray.h"
#include "isophote/scene/density_grid_impl.h"

namespace isophote {
namespace {

/// Values of all points from (0, 0, 0) to size - 1, x fastest.
class DenseVoxels : public Voxels {
 public:
  DenseVoxels(const std::array<int, 3>& size, std::vector<float> values) : size_(size), values_(std::move(values)) {}

  void corners(int i, int j, int k, float out[8]) const override {
    for (int n = 0; n < 8; ++n) out[n] = at(i + (n >> 2), j + (n >> 1 & 1), k + (n & 1));
  }

 private:
  float at(int i, int j, int k) const {
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return 0;
    return values_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j)) *
                       static_cast<std::size_t>(size_[0]) +
                   static_cast<std::size_t>(i)];
  }
  std::array<int, 3> size_;
  std::vector<float> values_;
};

/// A cell's corners and a place in it, in [0, 1].
struct Cell {
  float corner[8] = {};
  float x = 0, y = 0, z = 0;
};

/// The cell that holds `q`; all corners are 0 where the grid does not reach.
Cell cell_at(const Voxels& voxels, const IndexBox& points, const Vec3d& q) {
  Cell cell;
  int at[3];
  for (int a = 0; a < 3; ++a) {
    const double low = std::floor(q[a]);
    if (!(low >= points.lower[a] - 1.0 && low <= points.upper[a])) return cell;
    at[a] = static_cast<int>(low);
  }
  cell.x = static_cast<float>(q.x - at[0]), cell.y = static_cast<float>(q.y - at[1]);
  cell.z = static_cast<float>(q.z - at[2]);
  voxels.corners(at[0], at[1], at[2], cell.corner);
  return cell;
}

float mix(float a, float b, float t) { return a + (b - a) * t; }

float interpolate(const Cell& cell) {
  const float* v = cell.corner;
  const float low = mix(mix(v[0], v[1], cell.z), mix(v[2], v[3], cell.z), cell.y);
  const float high = mix(mix(v[4], v[5], cell.z), mix(v[6], v[7], cell.z), cell.y);
  return mix(low, high, cell.x);
}

/// Derivatives of the interpolant along the axes of the grid.
Vec3d slopes(const Cell& cell) {
  const float* v = cell.corner;
  const float edge[4] = {mix(v[0], v[1], cell.z), mix(v[2], v[3], cell.z), mix(v[4], v[5], cell.z),
                         mix(v[6], v[7], cell.z)};
  const auto along_z = [&](int n) { return v[n + 1] - v[n]; };
  return {mix(edge[2], edge[3], cell.y) - mix(edge[0], edge[1], cell.y),
          mix(edge[1] - edge[0], edge[3] - edge[2], cell.x),
          mix(mix(along_z(0), along_z(2), cell.y), mix(along_z(4), along_z(6), cell.y), cell.x)};
}

int block_of(int point) { return point >> std::countr_zero(static_cast<unsigned>(DensityGrid::block)); }

/// The blocks that hold cells with one of these points as a corner.
IndexBox reached_blocks(const IndexBox& points) {
  IndexBox blocks;
  for (std::size_t a = 0; a < 3; ++a)
    blocks.lower[a] = block_of(points.lower[a] - 1), blocks.upper[a] = block_of(points.upper[a]);
  return blocks;
}

std::uint64_t count(const IndexBox& box) {
  std::uint64_t product = 1;
  for (std::size_t a = 0; a < 3; ++a) product *= static_cast<std::uint64_t>(box.upper[a] - box.lower[a] + 1);
  return product;
}

}  // namespace

BlockMajorants::BlockMajorants(const IndexBox& points) : blocks_(reached_blocks(points)), values_(count(blocks_)) {}

std::uint64_t BlockMajorants::bytes(const IndexBox& points) { return sizeof(float) * count(reached_blocks(points)); }

std::size_t BlockMajorants::index(int i, int j, int k) const {
  const auto offset = [this](std::size_t a, int x) { return static_cast<std::size_t>(x - blocks_.lower[a]); };
  const auto size = [this](std::size_t a) { return static_cast<std::size_t>(blocks_.upper[a] - blocks_.lower[a] + 1); };
  return (offset(2, k) * size(1) + offset(1, j)) * size(0) + offset(0, i);
}

void BlockMajorants::raise(const IndexBox& points, float value) {
  largest_ = std::max(largest_, value);
  const IndexBox reached = reached_blocks(points);
  for (int k = reached.lower[2]; k <= reached.upper[2]; ++k)
    for (int j = reached.lower[1]; j <= reached.upper[1]; ++j)
      for (int i = reached.lower[0]; i <= reached.upper[0]; ++i) {
        float& here = values_[index(i, j, k)];
        here = std::max(here, value);
      }
}

float BlockMajorants::at(int i, int j, int k) const {
  const int block[3] = {i, j, k};
  for (std::size_t a = 0; a < 3; ++a)
    if (block[a] < blocks_.lower[a] || block[a] > blocks_.upper[a]) return 0;
  return values_[index(i, j, k)];
}

std::uint64_t hash_of(std::uint64_t seed, const Affine& map) {
  for (const Vec3d& v : {map.x, map.y, map.z, map.origin})
    for (int a = 0; a < 3; ++a) seed = hash(seed, std::bit_cast<std::uint64_t>(v[a]));
  return seed;
}

DensityGrid::DensityGrid(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
DensityGrid::~DensityGrid() = default;

std::shared_ptr<const DensityGrid> DensityGrid::from_values(const std::array<int, 3>& size, std::vector<float> values,
                                                            const Affine& to_world) {
  for (const int n : size) ISOPHOTE_CHECK(n, >=, 1);
  const IndexBox points{{0, 0, 0}, {size[0] - 1, size[1] - 1, size[2] - 1}};
  ISOPHOTE_CHECK(values.size(), ==, count(points));
  ISOPHOTE_CHECK(std::abs(to_world.determinant()), >, 0);
  BlockMajorants majorants(points);
  std::uint64_t content = hash(static_cast<std::uint64_t>(size[0]), static_cast<std::uint64_t>(size[1]),
                               static_cast<std::uint64_t>(size[2]));
  auto value = values.cbegin();
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i, ++value) {
        if (!(*value >= 0 && *value < infinity))
          throw UserError("density at point (" + std::to_string(i) + ", " + std::to_string(j) + ", " +
                          std::to_string(k) + ") is negative or not a number");
        majorants.raise({{i, j, k}, {i, j, k}}, *value);
        content = hash(content, std::bit_cast<std::uint32_t>(*value));
      }
  return std::make_shared<DensityGrid>(
      std::make_unique<Impl>(Impl{std::make_unique<DenseVoxels>(size, std::move(values)), points, std::move(majorants),
                                  to_world, to_world.inverse(), hash_of(content, to_world)}));
}

Vec3d DensityGrid::to_grid(const Vec3d& p) const { return impl_->to_grid.point(p); }
Vec3d DensityGrid::direction_to_grid(const Vec3d& d) const { return impl_->to_grid.vector(d); }

Box DensityGrid::grid_bounds() const {
  Box box;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    box.lower[a] = static_cast<float>(impl_->points.lower[n] - 1);
    box.upper[a] = static_cast<float>(impl_->points.upper[n] + 1);
  }
  return box;
}

Box DensityGrid::world_bounds() const {
  const Box grid = grid_bounds();
  Box world;
  for (int n = 0; n < 8; ++n) {
    const Vec3 corner{(n & 4 ? grid.upper : grid.lower).x, (n & 2 ? grid.upper : grid.lower).y,
                      (n & 1 ? grid.upper : grid.lower).z};
    const Vec3 p(impl_->to_world.point(Vec3d(corner)));
    Vec3 below, above;  // rounding must not cut off what is inside
    for (int a = 0; a < 3; ++a) below[a] = std::nextafter(p[a], -infinity), above[a] = std::nextafter(p[a], infinity);
    world.extend(below), world.extend(above);
  }
  return world;
}

float DensityGrid::density(const Vec3& p) const { return density_in_grid(impl_->to_grid.point(Vec3d(p))); }

float DensityGrid::density_in_grid(const Vec3d& q) const {
  return interpolate(cell_at(*impl_->voxels, impl_->points, q));
}

Vec3 DensityGrid::gradient(const Vec3& p) const {
  const Cell cell = cell_at(*impl_->voxels, impl_->points, impl_->to_grid.point(Vec3d(p)));
  return Vec3(impl_->to_grid.pull_back(slopes(cell)));
}

float DensityGrid::block_majorant(int i, int j, int k) const { return impl_->majorants.at(i, j, k); }
float DensityGrid::majorant() const { return impl_->majorants.largest(); }
std::uint64_t DensityGrid::content_hash() const { return impl_->hash; }

}  // namespace isophote
