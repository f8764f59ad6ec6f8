#include "isophote/load/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "isophote/load/gltf_materials.h"
#include "isophote/load/gltf_triangles.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

/// Farther from the origin, areas of triangles no longer fit a float.
constexpr float farthest = 1e9f;
/// Beyond, a float has no fraction left to find a texel with.
constexpr float largest_uv = 1e6f;

/// True where the normal of a triangle, computed in single precision as everything behind does, does not exist, or
/// where the triangle is thinner than its corners are exact.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double thinnest = 1e-7;  // about the relative spacing of floats
  if (!(length_squared(cross(b - a, c - a)) >= std::numeric_limits<float>::min())) return true;
  const Vec3d u(Vec3d(b) - Vec3d(a)), v(Vec3d(c) - Vec3d(a));
  const double longest = std::max({length_squared(u), length_squared(v), length_squared(v - u)});
  return length(cross(u, v)) <= thinnest * longest;
}

/// What reading all meshes shares.
struct MeshContext {
  const tinygltf::Model& model;
  std::span<const Material> materials;
  int default_material;
  const Warn& warn;
  std::size_t dropped = 0;            ///< degenerate triangles
  std::size_t without_triangles = 0;  ///< primitives of which nothing is left
};

class PrimitiveReader {
 public:
  PrimitiveReader(MeshContext& context, const tinygltf::Primitive& primitive, const Affine& to_world, std::string place)
      : context_(context), primitive_(primitive), to_world_(to_world), place_(std::move(place)) {}

  /// A mesh without triangles where the primitive has none.
  Mesh read() {
    const AccessorReader positions = attribute("POSITION", {TINYGLTF_TYPE_VEC3}, Components::floats);
    std::optional<AccessorReader> indices;
    if (primitive_.indices >= 0) {
      indices.emplace(context_.model, primitive_.indices);
      if (!indices->holds_indices())
        throw UserError(fmt::format("accessors[{}]: indices must be unsigned integers", primitive_.indices));
    }
    mesh_.material = primitive_.material >= 0 ? primitive_.material : context_.default_material;
    mesh_.triangles = assemble_triangles(primitive_.mode, indices, positions.count());
    used_ = compact_vertices(mesh_.triangles, positions.count());
    read_positions(positions);
    drop_degenerate(*triangle_count(primitive_.mode, indices ? indices->count() : positions.count()));
    if (to_world_.determinant() < 0)
      for (auto& triangle : mesh_.triangles) std::swap(triangle[1], triangle[2]);
    if (mesh_.triangles.empty()) return {};
    read_normals();
    read_tangents();
    read_texture_coordinates();
    read_colors();
    return std::move(mesh_);
  }

 private:
  bool has(const std::string& name) const { return primitive_.attributes.contains(name); }

  enum class Components { floats, floats_or_unorm };

  /// The accessor of an attribute that may have one of these types.
  AccessorReader attribute(const std::string& name, std::initializer_list<int> types, Components components) const {
    return with_place(name, [&] {
      AccessorReader reader(context_.model, primitive_.attributes.at(name));
      const int type = reader.component_type();
      const bool unorm =
          type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
      if (std::find(types.begin(), types.end(), reader.type()) == types.end()) throw UserError("has the wrong type");
      if (type != TINYGLTF_COMPONENT_TYPE_FLOAT && !(unorm && components == Components::floats_or_unorm))
        throw UserError("has the wrong component type");
      return reader;
    });
  }

  /// Checks that attribute `name` has an element for each vertex that is used.
  void check_count(const std::string& name, const AccessorReader& reader) const {
    if (!used_.empty() && used_.back() >= reader.count())
      throw UserError(fmt::format("{}: has {} elements, but vertex {} is used", name, reader.count(), used_.back()));
  }

  static Vec3d vector(const AccessorReader& reader, std::size_t i) {
    return {reader.value(i, 0), reader.value(i, 1), reader.value(i, 2)};
  }

  void read_positions(const AccessorReader& positions) {
    mesh_.positions.reserve(used_.size());
    for (const std::uint32_t id : used_) {
      const Vec3 p(to_world_.point(vector(positions, id)));
      if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= farthest) || !is_finite(p))
        throw UserError(
            fmt::format("POSITION: vertex {} is not a number, or farther than {:g} from the origin", id, farthest));
      mesh_.positions.push_back(p);
    }
  }

  void drop_degenerate(std::size_t declared) {
    const auto& p = mesh_.positions;
    std::erase_if(mesh_.triangles, [&](const Triangle& t) { return is_degenerate(p[t[0]], p[t[1]], p[t[2]]); });
    context_.dropped += declared - mesh_.triangles.size();
  }

  void read_normals() {
    if (!has("NORMAL")) return;
    const AccessorReader reader = attribute("NORMAL", {TINYGLTF_TYPE_VEC3}, Components::floats);
    check_count("NORMAL", reader);
    for (const std::uint32_t id : used_) {
      const Vec3d n = to_world_.normal(vector(reader, id));
      const double l = length(n);
      if (!(l > 0) || !std::isfinite(l)) {
        context_.warn(place_ + ": has normals without a direction: it is shaded flat");
        mesh_.normals.clear();
        return;
      }
      mesh_.normals.emplace_back(n / l);
    }
  }

  void read_tangents() {
    if (!has("TANGENT") || !has("NORMAL") || material().normal_texture.texture < 0) return;
    const AccessorReader reader = attribute("TANGENT", {TINYGLTF_TYPE_VEC4}, Components::floats);
    check_count("TANGENT", reader);
    const float handedness = to_world_.determinant() < 0 ? -1.0f : 1.0f;  // a mirror image turns the bitangent round
    for (const std::uint32_t id : used_) {
      const Vec3d t = to_world_.vector(vector(reader, id));
      const double l = length(t);
      if (!(l > 0) || !std::isfinite(l)) {
        context_.warn(place_ + ": has tangents without a direction: they are derived from texture coordinates");
        mesh_.tangents.clear(), mesh_.tangent_signs.clear();
        return;
      }
      mesh_.tangents.emplace_back(t / l);
      mesh_.tangent_signs.push_back(reader.value(id, 3) < 0 ? -handedness : handedness);
    }
  }

  void read_texture_coordinates() {
    std::array<bool, 2> wanted{};
    for (const TextureUse* use : texture_uses(material()))
      if (use->texture >= 0) wanted[static_cast<std::size_t>(use->uv_set)] = true;
    for (std::size_t set = 0; set < 2; ++set) {
      const std::string name = "TEXCOORD_" + std::to_string(set);
      if (!wanted[set]) continue;
      if (!has(name)) {
        context_.warn(place_ + ": lacks " + name + ", which its material needs: those textures are left out");
        continue;
      }
      const AccessorReader reader = attribute(name, {TINYGLTF_TYPE_VEC2}, Components::floats_or_unorm);
      check_count(name, reader);
      for (const std::uint32_t id : used_) {
        const Vec2 uv{reader.value(id, 0), reader.value(id, 1)};
        if (!(std::abs(uv.x) <= largest_uv && std::abs(uv.y) <= largest_uv))
          throw UserError(fmt::format("{}: vertex {} is not a number, or over {:g}", name, id, largest_uv));
        mesh_.uv[set].push_back(uv);
      }
    }
  }

  void read_colors() {
    if (!has("COLOR_0")) return;
    const AccessorReader reader =
        attribute("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, Components::floats_or_unorm);
    check_count("COLOR_0", reader);
    const bool has_alpha = reader.type() == TINYGLTF_TYPE_VEC4;
    const auto channel = [&](std::uint32_t id, std::size_t k) {
      const float value = reader.value(id, k);
      if (!std::isfinite(value)) throw UserError(fmt::format("COLOR_0: vertex {} is not a number", id));
      return std::clamp(value, 0.0f, 1.0f);
    };
    for (const std::uint32_t id : used_)
      mesh_.colors.push_back({{channel(id, 0), channel(id, 1), channel(id, 2)}, has_alpha ? channel(id, 3) : 1.0f});
  }

  const Material& material() const { return context_.materials[static_cast<std::size_t>(mesh_.material)]; }

  MeshContext& context_;
  const tinygltf::Primitive& primitive_;
  const Affine& to_world_;
  std::string place_;
  Mesh mesh_;
  std::vector<std::uint32_t> used_;  ///< ids of the vertices in the file
};

/// Calls `body(mesh, primitive, its place, placed node)` for every primitive of every instance.
template <class Body>
void for_each_primitive(const tinygltf::Model& model, std::span<const PlacedNode> nodes, const Body& body) {
  for (const PlacedNode& placed : nodes) {
    const int id = model.nodes[static_cast<std::size_t>(placed.node)].mesh;
    if (id < 0) continue;
    const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(id)];
    for (std::size_t j = 0; j < mesh.primitives.size(); ++j) {
      const std::string place =
          place_name("meshes", static_cast<std::size_t>(id), mesh.name) + ": primitives[" + std::to_string(j) + "]";
      with_place(place, [&] { body(mesh, mesh.primitives[j], place, placed); });
    }
  }
}

/// Why a primitive is left out, empty where it is read.
std::string reason_to_skip(const tinygltf::Primitive& primitive) {
  if (!triangle_count(primitive.mode, 0)) return fmt::format("mode {} is not triangles", primitive.mode);
  if (!primitive.attributes.contains("POSITION")) return "it has no POSITION";
  return {};
}

/// Takes what the primitive will need at most: its mesh, the numbering of its vertices, and the hierarchy over it.
void take_memory(const tinygltf::Model& model, const tinygltf::Primitive& primitive, MemoryBudget& budget,
                 const std::string& place) {
  constexpr std::uint64_t bytes_per_vertex =
      2 * sizeof(Vec3) + sizeof(Vec3) + sizeof(float) + 2 * sizeof(Vec2) + sizeof(Rgba);
  constexpr std::uint64_t bytes_per_triangle =
      sizeof(Triangle) + 100;  // and what Embree builds over it: an upper bound, see bench/run memory
  const auto count = [&](int accessor) { return model.accessors[static_cast<std::size_t>(accessor)].count; };
  const std::size_t vertices = count(primitive.attributes.at("POSITION"));
  const std::size_t corners = primitive.indices >= 0 ? count(primitive.indices) : vertices;
  if (vertices > 0xffffffffu || corners > 0xffffffffu) throw UserError("has over 2^32 vertices");
  const std::size_t triangles = *triangle_count(primitive.mode, corners);
  const std::size_t used = std::min(vertices, 3 * triangles);
  budget.take(sizeof(std::uint32_t) * vertices + bytes_per_vertex * used + bytes_per_triangle * triangles, place);
}

}  // namespace

std::vector<Mesh> read_meshes(const tinygltf::Model& model, std::span<const PlacedNode> nodes,
                              std::span<const Material> materials, int default_material, MemoryBudget& budget,
                              const Warn& warn) {
  for_each_primitive(model, nodes, [&](const auto&, const auto& primitive, const std::string& place, const auto&) {
    budget.take(sizeof(Mesh), place);
    if (reason_to_skip(primitive).empty()) take_memory(model, primitive, budget, "mesh data");
  });
  MeshContext context{model, materials, default_material, warn};
  std::vector<Mesh> meshes;
  for_each_primitive(
      model, nodes, [&](const auto& source, const auto& primitive, const std::string& place, const PlacedNode& placed) {
        if (const std::string reason = reason_to_skip(primitive); !reason.empty())
          return warn(place + ": is skipped: " + reason);
        Mesh mesh = PrimitiveReader(context, primitive, placed.to_world, place).read();
        if (mesh.triangles.empty()) {
          ++context.without_triangles;
          return;
        }
        mesh.node = model.nodes[static_cast<std::size_t>(placed.node)].name;
        mesh.name = source.name.empty() ? mesh.node : source.name;
        meshes.push_back(std::move(mesh));
      });
  if (context.dropped > 0) warn(fmt::format("{} degenerate triangles are left out", context.dropped));
  if (context.without_triangles > 0)
    warn(fmt::format("{} primitives without a triangle are left out", context.without_triangles));
  return meshes;
}

bool uses_default_material(const tinygltf::Model& model, std::span<const PlacedNode> nodes) {
  bool uses = false;
  for_each_primitive(model, nodes, [&](const auto&, const auto& primitive, const auto&, const auto&) {
    uses |= primitive.material < 0;
  });
  return uses;
}

}  // namespace isophote
