#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "isophote/derivatives/volume_sum.h"

namespace isophote {

/// A corner of a layer's triangles.
struct LayerVertex {
  Vec3d direction;
  double depth = 0;
  Rgbd radiance;
  Gradient<Rgbd> emitted;  ///< radiance times the layer's logarithmic gradient
  Vec3d turn;              ///< that gradient across the ray, in luminance, at unit distance

  Vec3d position() const { return direction * depth; }
};

/// One layer of a gather as a closed mesh: a row of vertices from each ring, and one at either pole, the mean of the
/// ring about it. Triangles have what `Triangle` of the user's holds.
template <class Triangle>
class LayerMesh {
 public:
  explicit LayerMesh(const SphereGather& gather)
      : gather_(gather), rows_(gather.strata.polar), columns_(gather.strata.azimuthal) {}

  /// False where all of the layer is black.
  bool set_vertices(int layer);

  /// Makes each triangle by make(a, b, c), corners in order around it so that its solid angle is positive.
  template <class Make>
  void set_triangles(Make&& make);

  /// Calls visit(a, b, left, right) for each edge from a to b, with the triangles on its sides.
  template <class Visit>
  void for_each_edge(Visit&& visit) const;

 private:
  const LayerVertex& vertex(int row, int k) const {
    return vertices_[static_cast<std::size_t>(row) * columns_ + k % columns_];
  }
  /// The triangles of the cell between rows r and r + 1, columns k and k + 1: that at the side of row r, and the other.
  /// They are cut from (r, k) to (r + 1, k + 1) where r + k is odd, else from (r + 1, k) to (r, k + 1).
  const Triangle& upper(int r, int k) const { return triangles_[2 * cell(r, k)]; }
  const Triangle& lower(int r, int k) const { return triangles_[2 * cell(r, k) + 1]; }
  const Triangle& at_column(int r, int k) const { return falls(r, k) ? lower(r, k) : upper(r, k); }
  const Triangle& at_next_column(int r, int k) const { return falls(r, k) ? upper(r, k) : lower(r, k); }
  std::size_t cell(int r, int k) const { return static_cast<std::size_t>(r) * columns_ + k; }
  static bool falls(int r, int k) { return (r + k) % 2 != 0; }

  LayerVertex pole(int row, double z) const;

  const SphereGather& gather_;
  int rows_, columns_;
  std::vector<LayerVertex> vertices_;
  std::array<LayerVertex, 2> poles_;
  std::vector<Triangle> triangles_;
  std::array<std::vector<Triangle>, 2> fans_;
};

template <class Triangle>
bool LayerMesh<Triangle>::set_vertices(int layer) {
  vertices_.clear();
  double farthest = 0;
  bool black = true;
  for (std::size_t i = 0; i < gather_.samples.size(); ++i) {
    const GatherLayer& l = gather_.layers[i * static_cast<std::size_t>(gather_.shells + 1) + layer];
    if (l.depth < infinity) farthest = std::max(farthest, static_cast<double>(l.depth));
    const Rgbd light(l.radiance);
    LayerVertex v{Vec3d(gather_.samples[i].direction), static_cast<double>(l.depth), light, {}, {}};
    if (!is_black(light)) {
      black = false;
      v.emitted = times(l.log_gradient, light);
      const Vec3d logarithmic = luminance_of(v.emitted) / luminance(light);
      v.turn = (logarithmic - v.direction * dot(logarithmic, v.direction)) * v.depth;
    }
    vertices_.push_back(v);
  }
  if (black || !(farthest > 0)) return false;  // of nothing but sky, nothing moves
  // The sky is as far as rounding allows: its 1/distance terms vanish.
  for (LayerVertex& v : vertices_)
    if (!(v.depth < infinity)) v.depth = 1e4 * farthest, v.turn = {};
  poles_ = {pole(0, 1), pole(rows_ - 1, -1)};
  return true;
}

template <class Triangle>
LayerVertex LayerMesh<Triangle>::pole(int row, double z) const {
  LayerVertex mean{{0, 0, z}, 0, {}, {}, {}};
  double inverse = 0;
  for (int k = 0; k < columns_; ++k) {
    const LayerVertex& v = vertex(row, k);
    inverse += 1 / v.depth / columns_;
    mean.radiance += v.radiance / columns_;
    add(mean.emitted, v.emitted, 1.0 / columns_);
    mean.turn += Vec3d{v.turn.x, v.turn.y, 0} / columns_;
  }
  mean.depth = 1 / inverse;
  return mean;
}

template <class Triangle>
template <class Make>
void LayerMesh<Triangle>::set_triangles(Make&& make) {
  triangles_.clear();
  for (int r = 0; r + 1 < rows_; ++r)
    for (int k = 0; k < columns_; ++k) {
      const LayerVertex &a = vertex(r, k), &b = vertex(r + 1, k), &c = vertex(r + 1, k + 1), &d = vertex(r, k + 1);
      triangles_.push_back(falls(r, k) ? make(a, c, d) : make(a, b, d));
      triangles_.push_back(falls(r, k) ? make(a, b, c) : make(b, c, d));
    }
  for (auto& fan : fans_) fan.clear();
  for (int k = 0; k < columns_; ++k) {
    fans_[0].push_back(make(poles_[0], vertex(0, k), vertex(0, k + 1)));
    fans_[1].push_back(make(poles_[1], vertex(rows_ - 1, k + 1), vertex(rows_ - 1, k)));
  }
}

template <class Triangle>
template <class Visit>
void LayerMesh<Triangle>::for_each_edge(Visit&& visit) const {
  const int last = rows_ - 1;
  for (int k = 0; k < columns_; ++k) {
    const int before = (k + columns_ - 1) % columns_;
    visit(poles_[0], vertex(0, k), fans_[0][k], fans_[0][before]);
    visit(poles_[1], vertex(last, k), fans_[1][before], fans_[1][k]);
    for (int r = 0; r <= last; ++r) {
      visit(vertex(r, k), vertex(r, k + 1), r == 0 ? fans_[0][k] : lower(r - 1, k),
            r == last ? fans_[1][k] : upper(r, k));
      if (r == last) continue;
      visit(vertex(r, k), vertex(r + 1, k), at_column(r, k), at_next_column(r, before));
      if (falls(r, k))
        visit(vertex(r, k), vertex(r + 1, k + 1), upper(r, k), lower(r, k));
      else
        visit(vertex(r + 1, k), vertex(r, k + 1), upper(r, k), lower(r, k));
    }
  }
}

}  // namespace isophote
