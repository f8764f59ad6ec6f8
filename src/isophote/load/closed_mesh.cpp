#include "isophote/load/closed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "isophote/core/error.h"

namespace isophote {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

auto coordinates(const Vec3& p) { return std::tuple(p.x, p.y, p.z); }

ClosedMesh weld(std::span<const Mesh* const> meshes) {
  ClosedMesh all;
  for (const Mesh* mesh : meshes)
    all.positions.insert(all.positions.end(), mesh->positions.begin(), mesh->positions.end());
  const auto less = [](const Vec3& a, const Vec3& b) { return coordinates(a) < coordinates(b); };
  std::sort(all.positions.begin(), all.positions.end(), less);
  all.positions.erase(std::unique(all.positions.begin(), all.positions.end()), all.positions.end());
  for (const Mesh* mesh : meshes)
    for (const Triangle& from : mesh->triangles) {
      Triangle& to = all.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto at = std::lower_bound(all.positions.begin(), all.positions.end(), mesh->positions[from[i]], less);
        to[i] = static_cast<std::uint32_t>(at - all.positions.begin());
      }
    }
  return all;
}

/// An edge between two vertices as a triangle goes along it.
struct Edge {
  std::uint32_t low, high;
  bool upwards;

  auto ends() const { return std::tuple(low, high); }
};

std::vector<Edge> sorted_edges(const ClosedMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      edges.push_back({low, high, low == t[i]});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
  return edges;
}

void require_closed(const ClosedMesh& mesh) {
  const std::vector<Edge> edges = sorted_edges(mesh);
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::find_if(edge, edges.end(), [&](const Edge& e) { return e.ends() != edge->ends(); });
    const Vec3 &a = mesh.positions[edge->low], &b = mesh.positions[edge->high];
    const auto fail = [&](const std::string& what) {
      throw UserError(fmt::format("is not closed: its edge from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) {}", a.x, a.y,
                                  a.z, b.x, b.y, b.z, what));
    };
    if (next - edge == 1) fail("belongs to one triangle");
    if (next - edge != 2) fail(fmt::format("belongs to {} triangles", next - edge));
    if (edge[0].upwards == edge[1].upwards) fail("belongs to two triangles that face opposite ways");
    edge = next;
  }
}

/// Relative to the first vertex, where far from the origin digits would be lost.
double signed_volume(const ClosedMesh& mesh) {
  double sum = 0;
  const Vec3d origin(mesh.positions.front());
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return Vec3d(mesh.positions[t[i]]) - origin; };
    sum += dot(corner(0), cross(corner(1), corner(2)));
  }
  return sum / 6;
}

}  // namespace

ClosedMesh closed_mesh(std::span<const Mesh* const> meshes) {
  ClosedMesh mesh = weld(meshes);
  require_closed(mesh);
  const double volume = signed_volume(mesh);
  if (volume == 0) throw UserError("encloses no volume");
  if (volume < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace isophote
