#include "isophote/load/vdb.h"

#include <fmt/format.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/load/messages.h"
#include "isophote/load/nano_voxels.h"
#include "isophote/load/vdb_input.h"
#include "isophote/scene/density_grid_impl.h"

namespace isophote {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using Leaf = FloatGrid::TreeType::LeafNodeType;
static_assert(Leaf::DIM == DensityGrid::block);

/// Reads one grid of a file. OpenVDB's own reader takes what is missing at the end for zeros.
class File : openvdb::io::Archive {
 public:
  explicit File(const std::string& path) : stream_(path) {
    refuse_other_formats();
    readHeader(stream_);
    openvdb::io::setStreamMetadataPtr(stream_, metadata_, false);
    openvdb::io::setVersion(stream_, libraryVersion(), fileVersion());
    openvdb::io::setDataCompression(stream_, compression());
    looked_ahead([&] { check_metadata(); });
    openvdb::MetaMap().readMeta(stream_);
  }

  FloatGrid::Ptr read(const std::string& name) {
    std::string others;
    for (std::int32_t left = readGridCount(stream_); left > 0; --left) {
      looked_ahead([&] {
        for (int texts = 3; texts > 0; --texts) stream_.read_text();  // name, type, whose values it shares
      });
      openvdb::io::GridDescriptor descriptor;
      const openvdb::GridBase::Ptr grid = descriptor.read(stream_);
      const std::string own = openvdb::io::GridDescriptor::nameAsString(descriptor.uniqueName());
      if (own == name) return read_tree(descriptor, grid);
      if (others.size() < 200) others += (others.empty() ? "" : ", ") + one_line(own);
      skip(descriptor, grid);
    }
    throw UserError(fmt::format("has no grid '{}': there are {}", name, others.empty() ? "none" : others));
  }

 private:
  void refuse_other_formats() {
    constexpr std::uint32_t oldest = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
    constexpr std::uint32_t newest = openvdb::OPENVDB_FILE_VERSION;
    std::int64_t magic = 0;
    stream_.read(reinterpret_cast<char*>(&magic), sizeof magic);
    if (magic != openvdb::OPENVDB_MAGIC) throw UserError("is no OpenVDB file");
    const std::uint32_t version = stream_.read_word();
    if (version < oldest || version > newest)
      throw UserError(
          fmt::format("is of version {} of the format: versions {} to {} can be read", version, oldest, newest));
    stream_.seekg(0);
  }

  /// Reads and then goes back to where it was.
  template <class Body>
  void looked_ahead(const Body& body) {
    const auto start = stream_.tellg();
    body();
    stream_.seekg(start);
  }

  /// Reads metadata as OpenVDB will, which believes lengths and, for types that it knows, does not look at them. True
  /// where they say that values are half floats.
  bool check_metadata() {
    bool half = false;
    for (std::uint32_t left = stream_.read_word(); left > 0; --left) {
      const std::string name = stream_.read_text(), type = stream_.read_text(), value = stream_.read_text();
      const bool fixed = type != "string" && type != "__delayedload" && openvdb::Metadata::isRegisteredType(type);
      const bool is_half = name == openvdb::GridBase::META_SAVE_HALF_FLOAT;
      if ((fixed && openvdb::Metadata::createMetadata(type)->size() != value.size()) || (is_half && type != "bool"))
        throw UserError(fmt::format("is damaged: its metadata '{}' have a wrong type or size", name));
      if (is_half) half = value[0] != 0;
    }
    return half;
  }

  void read_grid(const openvdb::io::GridDescriptor& descriptor, const openvdb::GridBase::Ptr& grid) {
    looked_ahead([&] {
      const std::uint32_t compression = stream_.read_word();
      const auto has = [compression](std::uint32_t flag) { return (compression & flag) != 0; };
      const bool half = check_metadata();
      if (half != descriptor.saveFloatAsHalf()) throw UserError("is damaged: are its values half floats or not?");
      stream_.check_nodes({stream_.tellg(), has(openvdb::io::COMPRESS_BLOSC), has(openvdb::io::COMPRESS_ZIP),
                           has(openvdb::io::COMPRESS_ACTIVE_MASK), half ? 2 : 4});
    });
    readGrid(grid, descriptor, stream_);
  }

  /// Goes on to the next grid, always forwards.
  void skip(const openvdb::io::GridDescriptor& descriptor, const openvdb::GridBase::Ptr& grid) {
    if (!inputHasGridOffsets()) {
      if (grid->isType<FloatGrid>()) return read_grid(descriptor, grid);
      throw UserError(fmt::format("does not say where its grids begin, and one of type {} stands before the named one",
                                  grid->valueType()));
    }
    if (descriptor.getEndPos() < stream_.tellg()) throw UserError("is damaged: a grid ends before it begins");
    descriptor.seekToEnd(stream_);
  }

  FloatGrid::Ptr read_tree(const openvdb::io::GridDescriptor& descriptor, const openvdb::GridBase::Ptr& grid) {
    const std::string name = openvdb::io::GridDescriptor::nameAsString(descriptor.uniqueName());
    if (!grid->isType<FloatGrid>())
      throw UserError(fmt::format("grid '{}' is of type {}: one of type float is needed", name, grid->valueType()));
    if (descriptor.isInstance())
      throw UserError(fmt::format("grid '{}' shares the values of '{}': name that one", name,
                                  openvdb::io::GridDescriptor::nameAsString(descriptor.instanceParentName())));
    if (inputHasGridOffsets()) descriptor.seekToGrid(stream_);
    read_grid(descriptor, grid);
    if (inputHasGridOffsets() && stream_.tellg() != descriptor.getEndPos())
      throw UserError(fmt::format("is damaged: grid '{}' does not end where it should", name));
    if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
      throw UserError(fmt::format("grid '{}' is a level set: a fog volume is needed", name));
    return openvdb::gridPtrCast<FloatGrid>(grid);
  }

  openvdb::io::StreamMetadata::Ptr metadata_ =
      std::make_shared<openvdb::io::StreamMetadata>();  // the stream points to it
  VdbInput stream_;
};

/// The map from coordinates of the grid to the world.
Affine map_of(const openvdb::math::Transform& transform) {
  if (!transform.isLinear()) throw UserError("its transform is a frustum: an affine one is needed");
  const openvdb::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();  // acts on rows
  const auto row = [&m](int i) { return Vec3d{m(i, 0), m(i, 1), m(i, 2)}; };
  const Affine map{row(0), row(1), row(2), row(3)};
  constexpr double smallest = 1e-9, largest = 1e9;  // m; meshes keep within the latter
  for (const Vec3d& axis : {map.x, map.y, map.z})
    if (!(length(axis) >= smallest && length(axis) <= largest))
      throw UserError(fmt::format("its voxels must be from {:g} to {:g} wide", smallest, largest));
  if (!(length(map.origin) <= largest))
    throw UserError(fmt::format("it is farther than {:g} from the origin", largest));
  const double flatness = std::abs(map.determinant()) / (length(map.x) * length(map.y) * length(map.z));
  if (!(flatness > 1e-6)) throw UserError("its transform flattens space");
  return map;
}

/// The points that may be above 0.
IndexBox active_points(const FloatGrid& grid, MemoryBudget& budget) {
  openvdb::CoordBBox box;
  if (!grid.tree().evalActiveVoxelBoundingBox(box)) return {{0, 0, 0}, {0, 0, 0}};
  constexpr int farthest = 1 << 23;  // beyond, places within a voxel are lost in floats
  IndexBox points;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    points.lower[n] = box.min()[a], points.upper[n] = box.max()[a];
    if (points.lower[n] < -farthest || points.upper[n] > farthest)
      throw UserError(fmt::format("it has voxels beyond {} in its own coordinates", farthest));
  }
  constexpr std::uint64_t most = 1 << 28;  // bytes
  const std::uint64_t bytes = BlockMajorants::bytes(points);
  const auto size = [&](std::size_t a) { return points.upper[a] - points.lower[a] + 1; };
  if (bytes > most) throw UserError(fmt::format("it spans {} x {} x {} voxels, too many", size(0), size(1), size(2)));
  budget.take(bytes, "grid");
  return points;
}

/// Checks active values and scales them, sets the others to 0, and gathers what is to be known of them.
class Values {
 public:
  BlockMajorants majorants;
  std::uint64_t hash = 0;

  Values(FloatGrid& grid, const IndexBox& points, float scale) : majorants(points), grid_(grid), scale_(scale) {
    take_tiles();
    for (auto leaf = grid.tree().beginLeaf(); leaf; ++leaf) take_leaf(*leaf);
    grid.tree().root().setBackground(0, false);
  }

 private:
  float scaled(float value, const Coord& at) const {
    if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
      throw UserError(fmt::format("density at voxel ({}, {}, {}) is {:g}: it must be a number >= 0", at.x(), at.y(),
                                  at.z(), value));
    return value * scale_;
  }

  void add_to_hash(const Coord& at, std::uint64_t bits) {
    const auto word = [](int x) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)); };
    hash = isophote::hash(hash, word(at.x()) << 32 | word(at.y()), word(at.z()), bits);
  }

  void take_tiles() {
    auto& tree = grid_.tree();
    auto on = tree.beginValueOn();
    on.setMaxDepth(decltype(on)::LEAF_DEPTH - 1);
    for (; on; ++on) {
      const openvdb::CoordBBox box = on.getBoundingBox();
      const float value = scaled(*on, box.min());
      on.setValue(value);
      IndexBox points;
      for (int a = 0; a < 3; ++a)
        points.lower[static_cast<std::size_t>(a)] = box.min()[a],
        points.upper[static_cast<std::size_t>(a)] = box.max()[a];
      majorants.raise(points, value);
      add_to_hash(box.min(), std::uint64_t{std::bit_cast<std::uint32_t>(value)} << 8 | on.getDepth());
    }
    auto off = tree.beginValueOff();
    off.setMaxDepth(decltype(off)::LEAF_DEPTH - 1);
    for (; off; ++off) off.setValue(0);
  }

  void take_leaf(Leaf& leaf) {
    float* values = leaf.buffer().data();
    float most = 0;
    std::uint64_t content = 0;
    for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
      if (!leaf.isValueOn(n)) {
        values[n] = 0;
        continue;
      }
      const Coord at = leaf.offsetToGlobalCoord(n);
      const float value = values[n] = scaled(values[n], at);
      most = std::max(most, value);
      content = mix_bits(content ^ (std::uint64_t{std::bit_cast<std::uint32_t>(value)} << 9 | n)) + n;
      // Only points on these sides reach other blocks than their own.
      constexpr int inner = DensityGrid::block - 1;
      if ((at.x() & inner) == 0 || (at.y() & inner) == 0 || (at.z() & inner) == 0) majorants.raise(point(at), value);
    }
    if (leaf.isEmpty()) return;
    add_to_hash(leaf.origin(), content);
    majorants.raise(point(leaf.origin().offsetBy(1)), most);
  }

  static IndexBox point(const Coord& at) { return {{at.x(), at.y(), at.z()}, {at.x(), at.y(), at.z()}}; }

  FloatGrid& grid_;
  const float scale_;
};

std::shared_ptr<const DensityGrid> convert(FloatGrid& grid, float scale, MemoryBudget& budget) {
  const Affine map = map_of(grid.transform());
  const IndexBox points = active_points(grid, budget);
  budget.take(2 * grid.memUsage(), "grid");  // as read, and as kept
  Values values(grid, points, scale);
  auto handle =
      nanovdb::openToNanoVDB<nanovdb::HostBuffer>(grid, nanovdb::StatsMode::Disable, nanovdb::ChecksumMode::Disable);
  budget.give_back(grid.memUsage());
  return std::make_shared<DensityGrid>(std::make_unique<DensityGrid::Impl>(
      DensityGrid::Impl{std::make_unique<NanoVoxels>(std::move(handle)), points, std::move(values.majorants), map,
                        map.inverse(), hash_of(values.hash, map)}));
}

}  // namespace

std::shared_ptr<const DensityGrid> read_vdb(const std::string& path, const std::string& grid, float scale,
                                            MemoryBudget& budget) {
  try {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!error) budget.take(size, "file");
    openvdb::initialize();
    const FloatGrid::Ptr source = File(path).read(grid);
    const auto result = with_place(fmt::format("grid '{}'", grid), [&] { return convert(*source, scale, budget); });
    if (!error) budget.give_back(size);
    return result;
  } catch (const UserError& error) {
    throw UserError(one_line(error.what()));
  } catch (const std::bad_alloc&) {
    throw UserError("does not fit in memory, or is damaged");
  } catch (const std::ios::failure&) {
    throw UserError("is damaged: it ends too early, or cannot be read");
  } catch (const std::exception& error) {
    throw UserError(one_line(fmt::format("is damaged: {}", error.what())));
  }
}

}  // namespace isophote
