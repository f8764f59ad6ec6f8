#include "isophote/load/gltf.h"

#include <filesystem>
#include <new>
#include <set>

#include "isophote/load/gltf_bytes.h"
#include "isophote/load/gltf_file.h"
#include "isophote/load/gltf_materials.h"
#include "isophote/load/gltf_meshes.h"
#include "isophote/load/gltf_nodes.h"
#include "isophote/load/gltf_views.h"
#include "isophote/load/messages.h"
#include "isophote/load/read_file.h"

namespace isophote {
namespace {

void read_materials(const GltfFile& file, bool with_default, MemoryBudget& budget, const Warn& warn, Scene& scene) {
  TextureTable textures(file, budget);
  for (std::size_t i = 0; i < file.model.materials.size(); ++i)
    scene.materials.push_back(read_material(file, i, textures, warn));
  if (with_default) scene.materials.emplace_back();
  scene.textures = textures.take();
}

Scene convert(const GltfFile& file, MemoryBudget& budget, const Warn& warn) {
  const std::vector<PlacedNode> nodes = place_nodes(file.model);
  Scene scene;
  for (const PlacedNode& placed : nodes) {
    if (auto camera = read_camera(file.model, placed)) scene.cameras.push_back(std::move(*camera));
    if (auto light = read_light(file.model, placed)) scene.lights.push_back(std::move(*light));
  }
  read_materials(file, uses_default_material(file.model, nodes), budget, warn, scene);
  const int default_material = static_cast<int>(file.model.materials.size());
  scene.meshes = read_meshes(file.model, nodes, scene.materials, default_material, budget, warn);
  if (scene.meshes.empty()) throw UserError("the scene has no triangles");
  if (scene.cameras.empty()) scene.cameras.push_back(default_view(scene.bounds()));
  return scene;
}

/// Runs `body(warn)`, in which every line gets `name: ` before it, and every warning is given once.
template <class Body>
Scene report_as(const std::string& name, const Warn& warn, const Body& body) {
  std::set<std::string> given;
  const Warn warn_once = [&](const std::string& text) {
    const std::string line = one_line(text);
    if (given.insert(line).second) warn(name + ": " + line);
  };
  try {
    return body(warn_once);
  } catch (const UserError& error) {
    throw UserError(name + ": " + one_line(error.what()));
  } catch (const std::bad_alloc&) {
    throw UserError(name + ": does not fit in memory");
  }
}

Scene parse_and_convert(std::span<const unsigned char> bytes, const std::filesystem::path& folder, MemoryBudget& budget,
                        const Warn& warn, std::vector<std::string>* files) {
  const GltfFile file = parse_gltf(bytes, folder, budget, warn);
  if (files) files->insert(files->end(), file.files.begin(), file.files.end());
  return convert(file, budget, warn);
}

}  // namespace

Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& name,
                      const std::filesystem::path& folder, std::uint64_t memory, const Warn& warn) {
  return report_as(name, warn, [&](const Warn& warn_once) {
    MemoryBudget budget(memory);
    return parse_and_convert(bytes, folder, budget, warn_once, nullptr);
  });
}

Scene load_gltf(const std::string& path, const Warn& warn, std::vector<std::string>* files) {
  return report_as(path, warn, [&](const Warn& warn_once) {
    MemoryBudget budget(physical_memory());
    const std::filesystem::path file(path);
    return parse_and_convert(read_file(file, budget), file.parent_path(), budget, warn_once, files);
  });
}

}  // namespace isophote
