#ifdef ISOPHOTE_OPENVDB

#include "load/vdb_fixture.h"

#ifdef __SANITIZE_ADDRESS__
/// OpenVDB loses the nodes that it was reading where reading fails.
extern "C" const char* __lsan_default_suppressions() { return "leak:libopenvdb"; }
#endif

namespace isophote::testing {
namespace {

using openvdb::Vec3d;

using VdbRefusal = VdbTest;

TEST_F(VdbRefusal, WhatIsNoDensityIsRefused) {
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

TEST_F(VdbRefusal, TransformsAreChecked) {
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

TEST_F(VdbRefusal, AbsurdSizesAreRefused) {
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

TEST_F(VdbRefusal, DamagedFilesAreRefused) {
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
TEST_F(VdbRefusal, AnyByteMayBeWrong) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "OpenVDB takes any byte for a bool";
#endif
  for (const std::uint32_t compression : {2u, 3u, 6u}) {
    write({noise()}, compression);
    const std::string whole = content();
    Random random(compression + 1);
    int refused = 0;
    for (int n = 0; n < 60; ++n) {
      std::string damaged = whole;
      const std::size_t within = n % 2 == 0 ? 900 : whole.size();
      damaged[static_cast<std::size_t>(random.next() * static_cast<float>(within))] =
          static_cast<char>(n % 5 == 0 ? 0xff : random.next() * 256);
      folder_.write("a.vdb", damaged);
      const std::string message = refusal();
      refused += !message.empty();
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
    EXPECT_GT(refused, 10);
  }
}

}  // namespace
}  // namespace isophote::testing

#endif
