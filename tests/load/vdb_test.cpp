#ifdef ISOPHOTE_OPENVDB

#include <openvdb/io/Stream.h>
#include <openvdb/tools/Interpolation.h>

#include "isophote/load/scene_file.h"
#include "load/vdb_fixture.h"

namespace isophote::testing {
namespace {

using openvdb::Vec3d;

using Vdb = VdbTest;

void expect_same(const DensityGrid& grid, const FloatGrid& source, double tolerance) {
  Random random(5);
  double sum = 0;
  for (int n = 0; n < 5000; ++n) {
    const Vec3d q(34.0 * random.next() - 16, 25.0 * random.next() - 5, 32.0 * random.next() + 118);
    const double expected = openvdb::tools::BoxSampler::sample(source.tree(), q);
    ASSERT_NEAR(grid.density_in_grid({q.x(), q.y(), q.z()}), expected, tolerance);
    const Vec3d p = source.transform().indexToWorld(q);
    ASSERT_NEAR(grid.density(Vec3(isophote::Vec3d(p.x(), p.y(), p.z()))), expected, 1e-3);
    const auto block = [](double x) { return static_cast<int>(std::floor(x / DensityGrid::block)); };
    ASSERT_LE(expected, grid.block_majorant(block(q.x()), block(q.y()), block(q.z())) * (1 + 1e-6));
    sum += expected;
  }
  EXPECT_GT(sum, 100);
}

TEST_F(Vdb, ValuesAndPlacesAreThoseOfTheFile) {
  auto grid = noise();
  grid->setTransform(some_map);
  for (const std::uint32_t compression : {0u, 1u, 2u, 3u, 4u, 6u}) {
    write({grid}, compression);
    expect_same(*read(), *grid, 1e-6);
  }
  grid->setSaveFloatAsHalf(true);
  write({grid}, openvdb::io::COMPRESS_ZIP);
  expect_same(*read(), *grid, 1e-3);
}

TEST_F(Vdb, TheNamedGridAmongOthers) {
  auto first = fog("heat"), grid = noise();
  first->tree().setValue({1, 2, 3}, 7);
  auto velocity = openvdb::Vec3SGrid::create();
  velocity->setName("velocity");
  velocity->tree().setValue({1, 2, 3}, openvdb::Vec3s(1, 2, 3));
  write({first, velocity, grid});
  expect_same(*read(), *grid, 1e-6);
  EXPECT_EQ(read(1, plenty, "heat")->majorant(), 7);
  EXPECT_EQ(refusal("smoke"), "has no grid 'smoke': there are heat, velocity, density");
  EXPECT_EQ(refusal("velocity"), "grid 'velocity' is of type vec3s: one of type float is needed");
}

TEST_F(Vdb, FilesWithoutOffsets) {
  auto first = fog("heat"), grid = noise();
  first->tree().setValue({1, 2, 3}, 7);
  std::ofstream out(path(), std::ios::binary);
  openvdb::io::Stream(out).write(openvdb::GridPtrVec{first, grid});
  out.close();
  expect_same(*read(), *grid, 1e-6);
  EXPECT_EQ(refusal("smoke"), "has no grid 'smoke': there are heat, density");
}

TEST_F(Vdb, ScaleMultipliesValues) {
  auto grid = noise();
  write({grid});
  const auto one = read(), three = read(3);
  EXPECT_NEAR(three->majorant(), 3 * one->majorant(), 1e-6);
  EXPECT_NEAR(three->density_in_grid({0.3, 5.5, 130.2}), 3 * one->density_in_grid({0.3, 5.5, 130.2}), 1e-6);
  EXPECT_NE(three->content_hash(), one->content_hash());
}

TEST_F(Vdb, TilesAndInactiveVoxels) {
  auto grid = fog();
  grid->tree().fill(openvdb::CoordBBox({0, 0, 0}, {127, 127, 127}), 2);
  grid->tree().setValueOff({64, 64, 64}, 100);
  grid->tree().setValueOn({128, 5, 5}, 3);
  write({grid});
  const auto read_back = read();
  EXPECT_EQ(read_back->majorant(), 3);
  EXPECT_EQ(read_back->density_in_grid({40.5, 3, 100.25}), 2);
  EXPECT_EQ(read_back->density_in_grid({64, 64, 64}), 0);
  EXPECT_EQ(read_back->density_in_grid({127.5, 5, 5}), 2.5f);
  EXPECT_EQ(read_back->density_in_grid({-0.5, 5, 5}), 1);
  EXPECT_EQ(read_back->block_majorant(-1, 15, 3), 2);
  EXPECT_EQ(read_back->block_majorant(15, 0, 0), 3);
  EXPECT_EQ(read_back->block_majorant(16, 0, 0), 3);
  EXPECT_EQ(read_back->block_majorant(16, 2, 0), 0);
  EXPECT_EQ(read_back->grid_bounds().lower, Vec3(-1, -1, -1));
  EXPECT_EQ(read_back->grid_bounds().upper, Vec3(129, 128, 128));
}

TEST_F(Vdb, EmptyGridsAreClearAir) {
  write({fog()});
  EXPECT_EQ(read()->majorant(), 0);
  EXPECT_EQ(read()->density({0, 0, 0}), 0);
}

TEST_F(Vdb, HashIsOfTheContent) {
  auto grid = noise();
  std::vector<std::uint64_t> seen;
  const auto expect_new = [&] {
    write({grid});
    const std::uint64_t hash = read()->content_hash();
    EXPECT_EQ(read()->content_hash(), hash);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), hash), 0) << seen.size();
    seen.push_back(hash);
  };
  expect_new();
  grid->tree().setValue({0, 0, 130}, 0.125f), expect_new();
  grid->tree().setValue({0, 0, 131}, 0.125f), expect_new();
  grid->tree().setValue({500, 0, 131}, 0.125f), expect_new();
  grid->setTransform(some_map), expect_new();
}

TEST_F(Vdb, ThePlumeOfTheProject) {
  MemoryBudget budget(plenty);
  const auto plume = read_vdb(ISOPHOTE_SOURCE_DIR "/scenes/plume.vdb", "density", 1, budget);
  EXPECT_GT(plume->majorant(), 0.8f);
  EXPECT_LT(plume->majorant(), 1.2f);
  const Box box = plume->world_bounds();
  EXPECT_NEAR(box.lower.y, 0, 0.1);
  EXPECT_NEAR(box.upper.y, 2.8, 0.1);
  EXPECT_GT(plume->density({0, 0.5f, 0}), 0.1f);
}

TEST_F(Vdb, InScenes) {
  auto grid = noise();
  grid->setTransform(some_map);
  write({grid});
  GltfBuilder builder;
  builder.triangle();
  folder_.write("a.glb", builder.glb());
  const auto load = [&](const std::string& media) {
    return load_scene(folder_.write("a.toml", "[scene]\nfile = 'a.glb'\n" + media), [](const std::string&) {});
  };
  const LoadedScene loaded = load(
      "[[media]]\nsigma_s = 1\ngrid = {file = 'a.vdb'}\n"
      "[[media]]\nsigma_a = 1\ngrid = {file = 'a.vdb'}\nbox = [[0, 0, 0], [1, 1, 1]]\n");
  ASSERT_EQ(loaded.scene.media.size(), 2u);
  EXPECT_EQ(std::count(loaded.files.begin(), loaded.files.end(), path()), 1);
  const auto& density = std::get<GridDensity>(loaded.scene.media[0].density);
  EXPECT_EQ(density, std::get<GridDensity>(loaded.scene.media[1].density));
  EXPECT_EQ(std::get<Box>(loaded.scene.media[0].bounds).lower, density->world_bounds().lower);
  EXPECT_EQ(std::get<Box>(loaded.scene.media[1].bounds).upper, Vec3(1, 1, 1));
  try {
    load("[[media]]\nsigma_s = 1\ngrid = {file = 'a.vdb', name = 'smoke'}\n");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.what(),
              (folder_.path() / "a.toml").string() + ":5: " + path() + ": has no grid 'smoke': there are density");
  }
}

}  // namespace
}  // namespace isophote::testing

#else

#include <gtest/gtest.h>

#include "isophote/core/error.h"
#include "isophote/load/vdb.h"

namespace isophote::testing {
namespace {

TEST(Vdb, IsRefusedWithoutOpenVdb) {
  MemoryBudget budget(1 << 20);
  EXPECT_THROW(read_vdb("a.vdb", "density", 1, budget), UserError);
}

}  // namespace
}  // namespace isophote::testing

#endif
