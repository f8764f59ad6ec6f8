#pragma once

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "isophote/load/vdb.h"
#include "load/gltf_builder.h"
#include "support/statistics.h"

namespace isophote::testing {

using openvdb::FloatGrid;
using statistics::Random;

/// Files written by OpenVDB in a folder of their own, and what reading them gives.
class VdbTest : public ::testing::Test {
 protected:
  VdbTest() { openvdb::initialize(); }

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

inline FloatGrid::Ptr fog(const std::string& name = "density") {
  auto grid = FloatGrid::create();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

/// About a ninth of the voxels of a box, which lies on both sides of 0.
inline FloatGrid::Ptr noise() {
  auto grid = fog();
  auto accessor = grid->getAccessor();
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const auto coordinate = [&](int low, int size) { return low + static_cast<int>(random.next() * size); };
    accessor.setValue({coordinate(-14, 30), coordinate(-3, 21), coordinate(120, 28)}, random.next());
  }
  return grid;
}

inline const auto some_map = openvdb::math::Transform::createLinearTransform(
    openvdb::Mat4d(0.5, 0.1, 0.0, 0.0, -0.2, 0.4, 0.1, 0.0, 0.0, 0.3, -0.6, 0.0, 10.0, -20.0, 3.0, 1.0));

}  // namespace isophote::testing
