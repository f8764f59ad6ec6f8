#pragma once

#include <optional>
#include <span>
#include <vector>

#include "isophote/cache/irradiance_cells.h"
#include "isophote/cache/octree.h"
#include "isophote/validity/neighbour_index.h"

namespace isophote {

/// A place that asks for its irradiance. `normal` decides which records serve (the interpolated normal that records
/// live on); `facing` is what the value is wanted for (the normal map's normal), reached by the rotational gradient.
struct Query {
  Vec3 position;
  Vec3 normal;
  Vec3 facing;
};

/// The host's test for what stands between a record and a query: refers to a callable bool(const Record&, const
/// Query&), true where the way between them is free, that outlives the lookup. Asked only where the record saw
/// something that near. An empty one takes every way to be free.
class OpenTest {
 public:
  OpenTest() = default;
  template <class Test>
  OpenTest(const Test& test)
      : test_(&test), call_([](const void* t, const Record& r, const Query& q) -> bool {
          return (*static_cast<const Test*>(t))(r, q);
        }) {}

  bool operator()(const Record& record, const Query& query) const { return !call_ || call_(test_, record, query); }

 private:
  const void* test_ = nullptr;
  bool (*call_)(const void*, const Record&, const Query&) = nullptr;
};

/// Records and the index that finds them. Reading is safe from any number of threads while nobody writes.
class RecordCache {
 public:
  explicit RecordCache(const Box& bounds) : bounds_(bounds), octree_(bounds), neighbours_(bounds), cells_(bounds) {}

  std::span<const Record> records() const { return records_; }
  const Box& bounds() const { return bounds_; }

  std::uint32_t insert(const Record& record);
  /// The records, for `settle` to change between insertions. Radii may only shrink: the index does not follow.
  Settling settling() { return {records_, neighbours_}; }
  /// What gathers have left where their rays hit.
  const IrradianceCells& cells() const { return cells_; }
  IrradianceCells& cells() { return cells_; }
  /// Builds the index anew, tight about footprints that have shrunk.
  void reindex();

  /// Irradiance at the query, interpolated among the records that serve it: sum of weight times extrapolated value over
  /// sum of weights [Ward, Heckbert 1992]. Nothing where no record serves.
  std::optional<Rgb> interpolate(const Query& query, OpenTest open = {}) const;
  /// Does any record serve?
  bool covers(const Query& query, OpenTest open = {}) const;

  /// Calls visit(id, error, weight) for all records that serve the query, in the order in which `interpolate` adds
  /// them up: `error` as the footprint measures it, `weight` not yet over the sum of all.
  template <class Visit>
  void visit_serving(const Query& query, OpenTest open, Visit&& visit) const;

  /// Calls visit(record) for all records whose footprint may reach `p`, and for some others near it.
  template <class Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    octree_.visit_near(p, [&](std::uint32_t id) { visit(records_[id]); });
  }

 private:
  Box bounds_;
  std::vector<Record> records_;
  Octree octree_;
  NeighbourIndex neighbours_;
  IrradianceCells cells_;
};

/// The error of using `record` at (position, normal), as its footprint measures it: under 1 inside. Infinite where the
/// record lies in front of the query [Ward, Rubinstein, Clear 1988] or on the other side of the surface.
float footprint_error(const Record& record, const Vec3& position, const Vec3& normal);

/// The same, and infinite where the record saw something between it and the query, and `open` finds it there.
float serving_error(const Record& record, const Query& query, OpenTest open);

/// Why a record serves a query or not: the first of these that holds.
enum class Standing : std::uint8_t {
  beyond_rim,   ///< the place lies outside the footprint
  facing_away,  ///< the record lies on the other side of the surface, or on one that faces away
  in_front,     ///< the record lies in front of the place
  turned,       ///< the normals differ too much at this distance
  blocked,      ///< something stands between
  serves,
};
Standing standing(const Record& record, const Query& query, OpenTest open);

/// The weight for an error in [0, 1).
float falloff_weight(Falloff falloff, float error);

template <class Visit>
void RecordCache::visit_serving(const Query& query, OpenTest open, Visit&& visit) const {
  octree_.any(query.position, [&](std::uint32_t id) {
    const Record& record = records_[id];
    const float error = serving_error(record, query, open);
    if (error < 1) visit(id, error, falloff_weight(record.footprint.falloff, error));
    return false;
  });
}

}  // namespace isophote
