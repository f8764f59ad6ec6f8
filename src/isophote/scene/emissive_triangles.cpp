#include "isophote/scene/emissive_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "isophote/scene/lit_blocks.h"

namespace isophote {
namespace {

using Corners = std::array<std::uint32_t, 3>;

bool used(const TextureUse& use, const Mesh& mesh) { return use.texture >= 0 && !mesh.uv[use.uv_set].empty(); }

/// Is the texture black all over a triangle, and wherever rounding may put the coordinates of its points?
bool black(const LitBlocks& blocks, const TextureUse& use, const Mesh& mesh, const Corners& ids) {
  const auto& m = use.matrix;
  Vec2 lower{infinity, infinity}, upper{-infinity, -infinity}, rounding;
  for (const std::uint32_t id : ids) {
    const Vec2 uv = mesh.uv[use.uv_set][id];
    const float x0 = m[0] * uv.x, x1 = m[1] * uv.y, y0 = m[3] * uv.x, y1 = m[4] * uv.y;
    const Vec2 at{x0 + x1 + m[2], y0 + y1 + m[5]};
    lower = {std::min(lower.x, at.x), std::min(lower.y, at.y)};
    upper = {std::max(upper.x, at.x), std::max(upper.y, at.y)};
    rounding.x = std::max(rounding.x, std::abs(x0) + std::abs(x1) + std::abs(m[2]));
    rounding.y = std::max(rounding.y, std::abs(y0) + std::abs(y1) + std::abs(m[5]));
  }
  const Vec2 margin = rounding * 0x1p-20f;
  return !blocks.lit(lower - margin, upper + margin);
}

/// How many texels the longest edge of a triangle spans.
float texel_span(const Texture& texture, const TextureUse& use, const Mesh& mesh, const Corners& ids) {
  const auto& uv = mesh.uv[use.uv_set];
  const auto& m = use.matrix;
  float longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 d = uv[ids[i]] - uv[ids[(i + 1) % 3]];
    const float x = (m[0] * d.x + m[1] * d.y) * static_cast<float>(texture.width);
    const float y = (m[3] * d.x + m[4] * d.y) * static_cast<float>(texture.height);
    longest = std::max(longest, std::sqrt(x * x + y * y));
  }
  return longest;
}

/// Into how many parts each edge should be cut so as to see how the light varies, `most` at most.
int parts(const Scene& scene, const EmissiveTriangle& t, int most) {
  if (!t.varies) return 1;
  const Mesh& mesh = scene.meshes[t.mesh];
  const Material& material = scene.materials[mesh.material];
  const Corners& ids = mesh.triangles[t.triangle];
  float wanted = 1;
  const auto see = [&](const TextureUse& use) {
    if (used(use, mesh)) wanted = std::max(wanted, texel_span(scene.textures[use.texture], use, mesh, ids));
  };
  see(material.emission_texture);
  if (material.alpha != Alpha::opaque) {
    see(material.base_color_texture);
    if (!mesh.colors.empty()) wanted = std::max(wanted, 8.0f);  // alpha of vertices is linear, but for a mask's edge
  }
  return static_cast<int>(std::ceil(std::min(wanted, static_cast<float>(most))));
}

/// Mean luminance of a triangle, at the middles of n^2 equal parts. Light may hide between them: where all are black it
/// is taken for half of what one lit part would make it.
double mean_luminance(const Scene& scene, const EmissiveTriangle& t, int n) {
  double sum = 0;
  const auto at = [&](float i, float j) {
    const float scale = 1 / static_cast<float>(n);
    sum += luminance(Rgbd(covered_emission(scene, {t.mesh, t.triangle, i * scale, j * scale})));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      at(static_cast<float>(i) + 1 / 3.0f, static_cast<float>(j) + 1 / 3.0f);
      if (i + j + 1 < n) at(static_cast<float>(i) + 2 / 3.0f, static_cast<float>(j) + 2 / 3.0f);
    }
  return (sum > 0 ? sum : 0.5 * luminance(Rgbd(t.radiance))) / (static_cast<double>(n) * n);
}

/// The triangles of a mesh that are not provably black.
void append(const Scene& scene, std::uint32_t m, std::map<int, LitBlocks>& blocks, std::vector<EmissiveTriangle>& out) {
  const Mesh& mesh = scene.meshes[m];
  const Material& material = scene.materials[mesh.material];
  if (is_black(material.emission)) return;
  const TextureUse& use = material.emission_texture;
  const bool textured = used(use, mesh);
  const LitBlocks* lit =
      textured ? &blocks.try_emplace(use.texture, scene.textures[use.texture]).first->second : nullptr;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners& ids = mesh.triangles[i];
    const Vec3 &p = mesh.positions[ids[0]], edge1 = mesh.positions[ids[1]] - p, edge2 = mesh.positions[ids[2]] - p;
    const Vec3 across = cross(edge1, edge2);
    const float size = length(across);
    if (!(size > 0) || (lit && black(*lit, use, mesh, ids))) continue;
    out.push_back({p, edge1, edge2, across / size, 0.5f * size, m, i, material.double_sided,
                   textured || material.alpha != Alpha::opaque, material.emission});
  }
}

}  // namespace

Rgb covered_emission(const Scene& scene, const Hit& hit) { return emission(scene, hit) * opacity(scene, hit); }

EmissiveTriangles emissive_triangles(const Scene& scene) {
  EmissiveTriangles out;
  std::map<int, LitBlocks> blocks;  // by texture
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) append(scene, m, blocks, out.triangles);

  constexpr double budget = 1 << 22;  // points looked at in the whole scene, a fraction of a second
  constexpr int finest = 256;
  const auto varying =
      std::count_if(out.triangles.begin(), out.triangles.end(), [](const auto& t) { return t.varies; });
  const double share = budget / std::max(1.0, static_cast<double>(varying));
  const int most = std::clamp(static_cast<int>(std::sqrt(share)), 1, finest);
  for (const EmissiveTriangle& t : out.triangles) {
    const double mean = mean_luminance(scene, t, parts(scene, t, most));
    out.powers.push_back(pi * t.area * mean * (t.double_sided ? 2 : 1));
  }
  return out;
}

}  // namespace isophote
