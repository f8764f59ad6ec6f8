#include "isophote/scene/scene.h"

namespace isophote {

Box Scene::bounds() const {
  Box box;
  for (const Mesh& mesh : meshes)
    for (const Vec3& p : mesh.positions) box.extend(p);
  return box;
}

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

}  // namespace isophote
