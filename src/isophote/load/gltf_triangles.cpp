#include "isophote/load/gltf_triangles.h"

#include <fmt/format.h>

#include "isophote/core/error.h"

namespace isophote {

std::optional<std::size_t> triangle_count(int mode, std::size_t vertices) {
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
      return vertices / 3;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return vertices < 3 ? 0 : vertices - 2;
    default:
      return {};
  }
}

std::vector<Triangle> assemble_triangles(int mode, const std::optional<AccessorReader>& indices,
                                         std::size_t vertex_count) {
  const auto vertex = [&](std::size_t i) {
    const std::uint32_t id = indices ? indices->index(i) : static_cast<std::uint32_t>(i);
    if (id >= vertex_count)
      throw UserError(fmt::format("index {} is out of range: there are {} vertices", id, vertex_count));
    return id;
  };
  const std::size_t count = *triangle_count(mode, indices ? indices->count() : vertex_count);
  std::vector<Triangle> triangles;
  triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Triangle t{};
    if (mode == TINYGLTF_MODE_TRIANGLES)
      t = {vertex(3 * i), vertex(3 * i + 1), vertex(3 * i + 2)};
    else if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      t = {vertex(0), vertex(i + 1), vertex(i + 2)};
    else if (i % 2 == 0)
      t = {vertex(i), vertex(i + 1), vertex(i + 2)};
    else
      t = {vertex(i), vertex(i + 2), vertex(i + 1)};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return triangles;
}

std::vector<std::uint32_t> compact_vertices(std::vector<Triangle>& triangles, std::size_t vertex_count) {
  constexpr std::uint32_t unused = 0xffffffff;
  std::vector<std::uint32_t> numbers(vertex_count, unused);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t id : triangle) numbers[id] = 0;
  std::vector<std::uint32_t> used;
  for (std::size_t id = 0; id < vertex_count; ++id)
    if (numbers[id] != unused) {
      numbers[id] = static_cast<std::uint32_t>(used.size());
      used.push_back(static_cast<std::uint32_t>(id));
    }
  for (Triangle& triangle : triangles)
    for (std::uint32_t& id : triangle) id = numbers[id];
  return used;
}

}  // namespace isophote
