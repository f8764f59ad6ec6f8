#include "isophote/derivatives/schwarzhaupt_2012.h"

#include <algorithm>

#include "isophote/derivatives/lambert_sum.h"
#include "isophote/derivatives/ward_heckbert_1992.h"

namespace isophote {
namespace {

struct Vertex {
  Vec3d position;  // local frame, from the record
  double distance = 0;
  Rgbd radiance;
};

/// Rows of vertices from the pole to the horizon, and between them cells of two triangles each.
class Mesh {
 public:
  Mesh(const HemisphereGather& gather, Horizon horizon);
  LambertSum sum() const;
  /// Is there anything but sky? If not, nothing moves.
  bool hits() const { return farthest_hit_ > 0; }

 private:
  /// Between row r and the next, column k and the next: a = (r, k), b = (r + 1, k), c = (r + 1, k + 1), d = (r, k + 1).
  /// The diagonal is a-c or b-d; `ab`, `bc`, `cd`, `da` are the radiances of the triangles at those sides.
  struct Cell {
    bool ac;
    Rgbd ab, bc, cd, da;
  };

  const Vertex& vertex(int row, int k) const {
    return vertices_[static_cast<std::size_t>(row) * columns_ + k % columns_];
  }
  const Cell& cell(int row, int k) const {
    return cells_[static_cast<std::size_t>(row) * columns_ + (k + columns_) % columns_];
  }
  static const Rgbd& farthest(const Vertex& a, const Vertex& b, const Vertex& c) {
    const Vertex& ab = b.distance > a.distance ? b : a;
    return c.distance > ab.distance ? c.radiance : ab.radiance;
  }
  void add_samples(const HemisphereGather& gather);
  void add_horizon(const HemisphereGather& gather);
  void add_cells();

  int columns_, rows_;
  double farthest_hit_ = 0;
  std::vector<Vertex> vertices_;
  Vertex pole_;
  std::vector<Cell> cells_;
};

Mesh::Mesh(const HemisphereGather& gather, Horizon horizon)
    : columns_(gather.strata.azimuthal), rows_(gather.strata.polar) {
  // A radiance all round adds nothing where the mesh is closed: all is taken relative to one sample's, so that a
  // furnace has exactly no derivatives. An open mesh ends at black.
  const Rgbd base = horizon == Horizon::closed ? Rgbd(gather.samples.front().radiance) : Rgbd();
  add_samples(gather);
  for (Vertex& v : vertices_) v.radiance -= base;
  double inverse = 0;
  for (int k = 0; k < columns_; ++k) {
    inverse += 1 / vertex(0, k).distance / columns_;
    pole_.radiance += vertex(0, k).radiance / columns_;
  }
  pole_.distance = 1 / inverse;
  pole_.position = {0, 0, pole_.distance};
  if (horizon == Horizon::closed) add_horizon(gather);
  add_cells();
}

/// The sky is as far as rounding allows: its 1/distance terms vanish. What lies under the record's own surface goes on
/// as what is seen above it, so that there is no edge between them.
void Mesh::add_samples(const HemisphereGather& gather) {
  for (const GatherSample& s : gather.samples)
    if (s.distance < infinity) farthest_hit_ = std::max(farthest_hit_, static_cast<double>(s.distance));
  const double sky = 1e4 * farthest_hit_;
  const Framed frame(gather.frame);
  const auto row = static_cast<std::size_t>(columns_);
  for (const GatherSample& s : gather.samples) {
    const Vec3d direction = frame.to_local(Vec3d(s.direction));
    if (s.surface == GatherSample::own_surface && vertices_.size() >= row) {
      const Vertex above = vertices_[vertices_.size() - row];
      vertices_.push_back({direction * above.distance, above.distance, above.radiance});
      continue;
    }
    const double distance = s.distance < infinity ? static_cast<double>(s.distance) : sky;
    vertices_.push_back({direction * distance, distance, Rgbd(s.radiance)});
  }
}

/// A row on the horizon, under the outermost ring, on its hits' tangent planes.
void Mesh::add_horizon(const HemisphereGather& gather) {
  const Framed frame(gather.frame);
  for (int k = 0; k < columns_; ++k) {
    const Vertex above = vertex(rows_ - 1, k);
    const Vec3d flat{above.position.x, above.position.y, 0}, w = flat / length(flat);
    const Vec3d normal = frame.to_local(Vec3d(gather.at(rows_ - 1, k).normal));
    const double to_plane = dot(normal, above.position), slope = dot(normal, w);
    const double t = slope * to_plane > 0 ? to_plane / slope : 2 * above.distance;
    const double distance = std::clamp(t, above.distance / 2, 2 * above.distance);
    vertices_.push_back({w * distance, distance, above.radiance});
  }
  ++rows_;
}

void Mesh::add_cells() {
  for (int r = 0; r + 1 < rows_; ++r)
    for (int k = 0; k < columns_; ++k) {
      const Vertex &a = vertex(r, k), &b = vertex(r + 1, k), &c = vertex(r + 1, k + 1), &d = vertex(r, k + 1);
      Cell cell{std::abs(a.distance - c.distance) <= std::abs(b.distance - d.distance), {}, {}, {}, {}};
      if (cell.ac) {
        cell.ab = cell.bc = farthest(a, b, c);
        cell.cd = cell.da = farthest(a, c, d);
      } else {
        cell.ab = cell.da = farthest(a, b, d);
        cell.bc = cell.cd = farthest(b, c, d);
      }
      cells_.push_back(cell);
    }
}

LambertSum Mesh::sum() const {
  LambertSum sum;
  const auto fan = [&](int k) -> const Rgbd& { return farthest(pole_, vertex(0, k), vertex(0, k + 1)); };
  for (int k = 0; k < columns_; ++k) {
    sum.add(pole_.position, vertex(0, k).position, fan(k), fan(k + columns_ - 1));
    for (int r = 0; r < rows_; ++r) {
      const Rgbd inside = r == 0 ? fan(k) : cell(r - 1, k).bc;
      const Rgbd outside = r + 1 < rows_ ? cell(r, k).da : Rgbd();
      sum.add(vertex(r, k).position, vertex(r, k + 1).position, inside, outside);
      if (r + 1 == rows_) continue;
      const Cell& here = cell(r, k);
      sum.add(vertex(r, k).position, vertex(r + 1, k).position, here.ab, cell(r, k - 1).cd);
      if (here.ac)
        sum.add(vertex(r, k).position, vertex(r + 1, k + 1).position, here.da, here.ab);
      else
        sum.add(vertex(r + 1, k).position, vertex(r, k + 1).position, here.ab, here.bc);
    }
  }
  return sum;
}

}  // namespace

Jet<Rgb> schwarzhaupt_2012(const HemisphereGather& gather, Horizon horizon) {
  Jet<Rgb> jet = irradiance(gather);
  jet.rotational = rotational_gradient(gather, RotationWeights::exact);
  const Mesh mesh(gather, horizon);
  if (!mesh.hits()) return jet;
  const LambertSum sum = mesh.sum();
  jet.translational = sum.gradient.to_world(gather.frame);
  jet.hessian = sum.hessian.to_world(gather.frame);
  return jet;
}

}  // namespace isophote
