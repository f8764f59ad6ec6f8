#include "isophote/load/vdb.h"

#include <gtest/gtest.h>

#include "isophote/load/scene_file.h"
#include "load/gltf_builder.h"

#ifdef ISOPHOTE_OPENVDB

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include "support/statistics.h"

#ifdef __SANITIZE_ADDRESS__
/// OpenVDB loses the nodes that it was reading where reading fails.
extern "C" const char* __lsan_default_suppressions() { return "leak:libopenvdb"; }
#endif

namespace isophote::testing {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;
using statistics::Random;

class Vdb : public ::testing::Test {
 protected:
  Vdb() { openvdb::initialize(); }

  std::string path(const std::string& name = "a.vdb") const { return (folder_.path() / name).string(); }

  std::string write(const openvdb::GridPtrVec& grids, std::uint32_t compression = openvdb::io::COMPRESS_ACTIVE_MASK) {
    openvdb::io::File file(path());
    file.setCompression(compression);
    file.write(grids);
    return path();
  }
  std::string content() const {
    std::ifstream in(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::shared_ptr<const DensityGrid> read(float scale = 1, std::uint64_t memory = plenty,
                                          const std::string& name = "density") {
    MemoryBudget budget(memory);
    return read_vdb(path(), name, scale, budget);
  }
  std::string refusal(const std::string& name = "density", std::uint64_t memory = plenty) {
    try {
      read(1, memory, name);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

FloatGrid::Ptr fog(const std::string& name = "density") {
  auto grid = FloatGrid::create();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

/// About a ninth of the voxels of a box, which lies on both sides of 0.
FloatGrid::Ptr noise() {
  auto grid = fog();
  auto accessor = grid->getAccessor();
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const auto coordinate = [&](int low, int size) { return low + static_cast<int>(random.next() * size); };
    accessor.setValue({coordinate(-14, 30), coordinate(-3, 21), coordinate(120, 28)}, random.next());
  }
  return grid;
}

const auto some_map = openvdb::math::Transform::createLinearTransform(
    openvdb::Mat4d(0.5, 0.1, 0.0, 0.0, -0.2, 0.4, 0.1, 0.0, 0.0, 0.3, -0.6, 0.0, 10.0, -20.0, 3.0, 1.0));

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

TEST_F(Vdb, WhatIsNoDensityIsRefused) {
  for (const auto& [value, shown] : {std::pair{-0.5f, "-0.5"}, {std::nanf(""), "nan"}, {INFINITY, "inf"}}) {
    auto grid = noise();
    grid->tree().setValue({1, 2, 125}, value);
    write({grid});
    EXPECT_EQ(refusal(),
              "grid 'density': density at voxel (1, 2, 125) is " + std::string(shown) + ": it must be a number >= 0");
  }
  auto level_set = noise();
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  write({level_set});
  EXPECT_EQ(refusal(), "grid 'density' is a level set: a fog volume is needed");
}

TEST_F(Vdb, TransformsAreChecked) {
  auto grid = noise();
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0), Vec3d(10)), 0.5, 10, 1));
  write({grid});
  EXPECT_EQ(refusal(), "grid 'density': its transform is a frustum: an affine one is needed");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(2e9));
  write({grid});
  EXPECT_EQ(refusal(), "grid 'density': its voxels must be from 1e-09 to 1e+09 wide");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(
      openvdb::Mat4d(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1e12, 0.0, 1.0)));
  write({grid});
  EXPECT_EQ(refusal(), "grid 'density': it is farther than 1e+09 from the origin");
}

TEST_F(Vdb, AbsurdSizesAreRefused) {
  auto far = fog();
  far->tree().setValue({0, 0, 1 << 24}, 1);
  write({far});
  EXPECT_EQ(refusal(), "grid 'density': it has voxels beyond 8388608 in its own coordinates");
  auto wide = fog();
  wide->tree().setValue({0, 0, 0}, 1), wide->tree().setValue({9999, 19999, 29999}, 1);
  write({wide});
  EXPECT_EQ(refusal(), "grid 'density': it spans 10000 x 20000 x 30000 voxels, too many");
  write({noise()});
  EXPECT_EQ(refusal("density", 4000).find("file: does not fit in memory"), 0u);
  EXPECT_EQ(refusal("density", 300000).find("grid 'density': grid: does not fit in memory"), 0u);
}

TEST_F(Vdb, DamagedFilesAreRefused) {
  write({noise()}, openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  const std::string whole = content();
  for (std::size_t size = 0; size < whole.size(); size += std::max<std::size_t>(1, size / 20)) {
    folder_.write("a.vdb", whole.substr(0, size));
    EXPECT_EQ(refusal().find("is damaged: "), 0u) << size;
  }
  folder_.write("a.vdb", std::string(1000, 'x'));
  EXPECT_EQ(refusal(), "is no OpenVDB file");
  std::string newer = whole;
  newer[8] = '\xff';
  folder_.write("a.vdb", newer);
  EXPECT_EQ(refusal(), "is of version 255 of the format: versions 222 to 224 can be read");
  std::string longer = whole;
  const std::size_t type = whole.find("Tree_float");
  ASSERT_NE(type, std::string::npos);
  longer[type + 5] = 'x';
  folder_.write("a.vdb", longer);
  EXPECT_EQ(refusal().find("is damaged: LookupError: "), 0u) << refusal();
}

/// Whatever a changed byte does, it gives a grid or one clear line.
TEST_F(Vdb, AnyByteMayBeWrong) {
  for (const std::uint32_t compression : {2u, 3u, 6u}) {
    write({noise()}, compression);
    const std::string whole = content();
    Random random(compression + 1);
    int refused = 0;
    for (int n = 0; n < 150; ++n) {
      std::string damaged = whole;
      const std::size_t within = n % 2 == 0 ? 900 : whole.size();
      damaged[static_cast<std::size_t>(random.next() * static_cast<float>(within))] =
          static_cast<char>(n % 5 == 0 ? 0xff : random.next() * 256);
      folder_.write("a.vdb", damaged);
      const std::string message = refusal();
      refused += !message.empty();
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
    EXPECT_GT(refused, 20);
  }
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

namespace isophote::testing {
namespace {

TEST(Vdb, IsRefusedWithoutOpenVdb) {
  MemoryBudget budget(plenty);
  EXPECT_THROW(read_vdb("a.vdb", "density", 1, budget), UserError);
}

}  // namespace
}  // namespace isophote::testing

#endif
