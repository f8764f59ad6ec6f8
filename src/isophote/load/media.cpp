#include "isophote/load/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "isophote/load/closed_mesh.h"
#include "isophote/load/largest_extinction.h"
#include "isophote/load/largest_radiance.h"
#include "isophote/load/messages.h"
#include "isophote/load/vdb.h"
#include "isophote/scene/density_grid.h"

namespace isophote {
namespace {

bool is_called(const Mesh& mesh, const std::string& name) { return mesh.name == name || mesh.node == name; }

ClosedMesh boundary(const SceneToml::Medium::Boundary& source, const Scene& scene, MemoryBudget& budget) {
  std::vector<const Mesh*> parts;
  std::uint64_t triangles = 0;
  for (const Mesh& mesh : scene.meshes)
    if (is_called(mesh, source.mesh)) parts.push_back(&mesh), triangles += mesh.triangles.size();
  if (parts.empty()) throw UserError(one_line(fmt::format("no mesh or node is called '{}'", source.mesh)));
  constexpr std::uint64_t bytes_per_triangle = 200;  // vertices, edges, and the hierarchy that rays use
  const std::string what = one_line("mesh '" + source.mesh + "'");
  budget.take(bytes_per_triangle * triangles, what);
  try {
    return closed_mesh(parts);
  } catch (const UserError& error) {
    throw UserError(what + " " + error.what());
  }
}

Box box_of(const ClosedMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

using Sources = std::vector<SceneToml::Medium>;

bool bounds_media(const Mesh& mesh, const Sources& sources) {
  return std::any_of(sources.begin(), sources.end(), [&](const SceneToml::Medium& source) {
    return source.boundary && is_called(mesh, source.boundary->mesh);
  });
}

/// Of what is to be seen.
Box seen_bounds(const Scene& scene, const Sources& sources) {
  Box box;
  for (const Mesh& mesh : scene.meshes)
    if (!bounds_media(mesh, sources))
      for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

class MediaReader {
 public:
  MediaReader(const std::filesystem::path& folder, MemoryBudget& budget, const Scene& scene, const Sources& sources)
      : folder_(folder), budget_(budget), scene_(scene), seen_bounds_(seen_bounds(scene, sources)) {}

  Medium read(const SceneToml::Medium& source) {
    Medium medium;
    medium.name = source.name;
    medium.scattering = source.scattering, medium.absorption = source.absorption;
    medium.emission = source.emission;
    medium.g = source.g;
    if (source.height) medium.density = *source.height;
    if (source.grid) medium.density = grid(*source.grid);
    read_bounds(source, medium);
    require_bounded(source, medium);
    return medium;
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  /// One that several media name is read once.
  GridDensity grid(const SceneToml::Medium::Grid& source) {
    const std::string path = resolve(source.file, folder_);
    GridDensity& grid = grids_[std::tuple(path, source.name, source.scale)];
    if (grid) return grid;
    const auto scale = static_cast<float>(source.scale);
    grid = with_place(source.file.place + ": " + path, [&] { return read_vdb(path, source.name, scale, budget_); });
    if (std::find(files_.begin(), files_.end(), path) == files_.end()) files_.push_back(path);
    return grid;
  }

  void read_bounds(const SceneToml::Medium& source, Medium& medium) {
    if (source.boundary)
      medium.bounds = with_place(source.boundary->place, [&] { return boundary(*source.boundary, scene_, budget_); });
    else if (source.box)
      medium.bounds = *source.box;
    else if (const auto* density = std::get_if<GridDensity>(&medium.density))
      medium.bounds = (*density)->world_bounds();
    else
      medium.bounds = scene_box(source);
  }

  const Box& scene_box(const SceneToml::Medium& source) const {
    const Vec3 size = seen_bounds_.upper - seen_bounds_.lower;
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
      throw UserError(fmt::format("{}: [[media]] needs a box: what is to be seen encloses nothing", source.place));
    return seen_bounds_;
  }

  /// Refuses media that are somewhere denser or brighter than numbers are good for.
  static void require_bounded(const SceneToml::Medium& source, const Medium& medium) {
    double density = 1;
    if (const auto* height = std::get_if<HeightDensity>(&medium.density)) {
      const auto* mesh = std::get_if<ClosedMesh>(&medium.bounds);
      const double lowest = (mesh ? box_of(*mesh) : std::get<Box>(medium.bounds)).lower.y;
      density = std::exp((height->base - lowest) / height->height);
    } else if (const auto* grid = std::get_if<GridDensity>(&medium.density)) {
      density = (*grid)->majorant();
    }
    const double extinction = density * max_component(medium.extinction());
    if (!(extinction <= largest_extinction))
      throw UserError(fmt::format("{}: [[media]] is too dense: sigma_t comes to {:g}/m, above {:g}", source.place,
                                  extinction, largest_extinction));
    const double emission = density * max_component(medium.emission);
    if (!(emission <= largest_radiance))
      throw UserError(fmt::format("{}: [[media]] is too bright: emission comes to {:g}, above {:g}", source.place,
                                  emission, largest_radiance));
  }

  const std::filesystem::path& folder_;
  MemoryBudget& budget_;
  const Scene& scene_;
  Box seen_bounds_;
  std::map<std::tuple<std::string, std::string, double>, GridDensity> grids_;
  std::vector<std::string> files_;
};

}  // namespace

void add_media(const Sources& sources, const std::filesystem::path& folder, MemoryBudget& budget, Scene& scene,
               std::vector<std::string>& files) {
  if (sources.empty()) return;
  MediaReader reader(folder, budget, scene, sources);
  for (const SceneToml::Medium& source : sources) scene.media.push_back(reader.read(source));
  files.insert(files.end(), reader.files().begin(), reader.files().end());
  std::erase_if(scene.meshes, [&](const Mesh& mesh) { return bounds_media(mesh, sources); });
}

}  // namespace isophote
