#include "isophote/load/closed_mesh.h"

#include <gtest/gtest.h>

#include "isophote/core/error.h"
#include "support/scenes.h"

namespace isophote {
namespace {

double volume(const ClosedMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]))) / 6;
  return sum;
}

ClosedMesh closed(const Mesh& mesh) {
  const Mesh* parts[] = {&mesh};
  return closed_mesh(parts);
}

std::string refusal(const Mesh& mesh) {
  try {
    closed(mesh);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

/// Each triangle with vertices of its own.
Mesh unwelded(const Mesh& mesh) {
  Mesh out;
  for (const auto& t : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t id : t) out.positions.push_back(mesh.positions[id]);
    out.triangles.push_back({n, n + 1, n + 2});
  }
  return out;
}

const Mesh brick = scenes::box({1, 2, 3}, {2, 4, 6}, false, 0);

TEST(ClosedMesh, WeldsAndFacesOutwards) {
  Mesh flipped = unwelded(brick);
  for (auto& t : flipped.triangles) std::swap(t[0], t[1]);
  for (const Mesh& mesh : {brick, unwelded(brick), flipped}) {
    const ClosedMesh surface = closed(mesh);
    EXPECT_EQ(surface.positions.size(), 8u);
    EXPECT_EQ(surface.triangles.size(), 12u);
    EXPECT_NEAR(volume(surface), 6, 1e-5);
  }
}

TEST(ClosedMesh, PartsMayCloseEachOther) {
  Mesh lid = unwelded(brick), rest = lid;
  lid.triangles.resize(2);
  rest.triangles.erase(rest.triangles.begin(), rest.triangles.begin() + 2);
  const Mesh* parts[] = {&lid, &rest};
  EXPECT_NEAR(volume(closed_mesh(parts)), 6, 1e-5);
}

TEST(ClosedMesh, NegativeZeroIsZero) {
  Mesh mesh = unwelded(scenes::box({0, 0, 0}, {1, 1, 1}, false, 0));
  for (std::size_t i = 0; i < mesh.positions.size(); i += 2)
    for (int a = 0; a < 3; ++a)
      if (mesh.positions[i][a] == 0) mesh.positions[i][a] = -0.0f;
  EXPECT_NEAR(volume(closed(mesh)), 1, 1e-6);
}

TEST(ClosedMesh, HolesAndTwistsAreRefused) {
  Mesh open = brick;
  open.triangles.pop_back();
  EXPECT_EQ(refusal(open).find("is not closed: its edge from ("), 0u);
  EXPECT_NE(refusal(open).find(") belongs to one triangle"), std::string::npos);
  Mesh twisted = brick;
  std::swap(twisted.triangles[5][0], twisted.triangles[5][1]);
  EXPECT_NE(refusal(twisted).find("belongs to two triangles that face opposite ways"), std::string::npos);
  Mesh fin = brick;
  fin.positions.push_back({9, 9, 9});
  fin.triangles.push_back({0, 1, static_cast<std::uint32_t>(fin.positions.size() - 1)});
  EXPECT_EQ(refusal(fin).find("is not closed"), 0u);
  Mesh doubled = brick;
  doubled.triangles.insert(doubled.triangles.end(), brick.triangles.begin(), brick.triangles.end());
  EXPECT_NE(refusal(doubled).find("belongs to 4 triangles"), std::string::npos);
}

TEST(ClosedMesh, FlatOnesEncloseNothing) {
  Mesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.triangles = {{{0, 1, 2}}, {{0, 2, 1}}};
  EXPECT_EQ(refusal(flat), "encloses no volume");
}

}  // namespace
}  // namespace isophote
