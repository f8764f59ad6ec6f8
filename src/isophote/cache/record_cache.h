#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
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

/// The host's test for what stands between a record and a query: refers to a callable bool(const Site&, const Q&), true
/// where the way between them is free, that outlives the lookup. Asked only where the record saw something that near.
/// An empty one takes every way to be free.
template <class Q>
class OpenTestOf {
 public:
  OpenTestOf() = default;
  template <class Test>
  OpenTestOf(const Test& test)
      : test_(&test),
        call_([](const void* t, const Site& r, const Q& q) -> bool { return (*static_cast<const Test*>(t))(r, q); }) {}

  bool operator()(const Site& record, const Q& query) const { return !call_ || call_(test_, record, query); }

 private:
  const void* test_ = nullptr;
  bool (*call_)(const void*, const Site&, const Q&) = nullptr;
};
using OpenTest = OpenTestOf<Query>;

/// Records and the index that finds them for queries `Q`, which have a `position`. Which of them serve is said by
/// serving_error(record, query, open). Reading is safe from any number of threads while nobody writes.
template <class R, class Q = Query>
class RecordStore {
 public:
  explicit RecordStore(const Box& bounds) : bounds_(bounds), octree_(bounds), neighbours_(bounds) {}

  std::span<const R> records() const { return records_; }
  const Box& bounds() const { return bounds_; }

  std::uint32_t insert(R record);
  /// The records, for `settle` to change between insertions. Radii may only shrink: the index does not follow.
  SettlingOf<R> settling() { return {records_, neighbours_}; }
  /// Makes a radius so much smaller, within its bounds, of which this is one from now on.
  void shrink(std::uint32_t id, float by) {
    Footprint& footprint = records_[id].footprint;
    footprint.largest = std::max(footprint.smallest, footprint.radius * by);
    footprint.resize(footprint.largest);
  }
  /// Builds the index anew, tight about footprints that have shrunk.
  void reindex();

  /// Calls visit(id, error, weight) for all records that serve the query, in an order fixed by the insertions: `error`
  /// as the footprint measures it, `weight` not yet over the sum of all.
  template <class Visit>
  void visit_serving(const Q& query, OpenTestOf<Q> open, Visit&& visit) const;

  /// Calls visit(record) for all records whose footprint may reach `p`, and for some others near it.
  template <class Visit>
  void visit_near(const Vec3& p, Visit&& visit) const {
    octree_.visit_near(p, [&](std::uint32_t id) { visit(records_[id]); });
  }

 protected:
  /// Does any record serve of which test(record) holds?
  template <class Test>
  bool any_serving(const Q& query, OpenTestOf<Q> open, Test&& test) const;

 private:
  Box bounds_;
  std::vector<R> records_;
  Octree octree_;
  NeighbourIndex neighbours_;
};

class RadianceCache;
struct VolumeCaches;

/// What is known of the light in a scene: irradiance by records, what gathers have left where their rays hit, and, if
/// those are cached at all, incident radiance and radiance in media.
class RecordCache : public RecordStore<Record> {
 public:
  explicit RecordCache(const Box& bounds) : RecordStore(bounds), cells_(bounds) {}

  const IrradianceCells& cells() const { return cells_; }
  IrradianceCells& cells() { return cells_; }
  /// Null where none is cached. Copies of this cache share it.
  const std::shared_ptr<RadianceCache>& radiance() const { return radiance_; }
  void set_radiance(std::shared_ptr<RadianceCache> radiance) { radiance_ = std::move(radiance); }
  /// Likewise.
  const std::shared_ptr<VolumeCaches>& volumes() const { return volumes_; }
  void set_volumes(std::shared_ptr<VolumeCaches> volumes) { volumes_ = std::move(volumes); }

  /// Irradiance at the query, interpolated among the records that serve it: sum of weight times extrapolated value over
  /// sum of weights [Ward, Heckbert 1992], in the order of `visit_serving`. Nothing where no record serves.
  std::optional<Rgb> interpolate(const Query& query, OpenTest open = {}) const;
  /// Does any record serve?
  bool covers(const Query& query, OpenTest open = {}) const {
    return any_serving(query, open, [](const Record&) { return true; });
  }

 private:
  IrradianceCells cells_;
  std::shared_ptr<RadianceCache> radiance_;
  std::shared_ptr<VolumeCaches> volumes_;
};

/// The error of using `record` at (position, normal), as its footprint measures it: under 1 inside. Infinite where the
/// record lies in front of the query [Ward, Rubinstein, Clear 1988] or on the other side of the surface.
float footprint_error(const Site& record, const Vec3& position, const Vec3& normal);

/// The same, and infinite where the record saw something between it and the query, and `open` finds it there.
template <class R>
float serving_error(const R& record, const Query& query, OpenTest open);

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

template <class R>
float serving_error(const R& record, const Query& query, OpenTest open) {
  const float error = footprint_error(record, query.position, query.normal);
  if (!(error < 1)) return error;
  const bool unsure = record.jet.distances.obstacles.before(query.position - record.position, record.normal);
  return unsure && !open(record, query) ? std::numeric_limits<float>::infinity() : error;
}

template <class R, class Q>
std::uint32_t RecordStore<R, Q>::insert(R record) {
  const auto id = static_cast<std::uint32_t>(records_.size());
  octree_.insert(id, record.position, record.footprint.radius);
  records_.push_back(std::move(record));
  return id;
}

template <class R, class Q>
void RecordStore<R, Q>::reindex() {
  octree_ = Octree(bounds_);
  for (std::uint32_t id = 0; id < records_.size(); ++id)
    octree_.insert(id, records_[id].position, records_[id].footprint.radius);
}

template <class R, class Q>
template <class Visit>
void RecordStore<R, Q>::visit_serving(const Q& query, OpenTestOf<Q> open, Visit&& visit) const {
  octree_.any(query.position, [&](std::uint32_t id) {
    const R& record = records_[id];
    const float error = serving_error(record, query, open);
    if (error < 1) visit(id, error, falloff_weight(record.footprint.falloff, error));
    return false;
  });
}

template <class R, class Q>
template <class Test>
bool RecordStore<R, Q>::any_serving(const Q& query, OpenTestOf<Q> open, Test&& test) const {
  return octree_.any(query.position, [&](std::uint32_t id) {
    return test(records_[id]) && serving_error(records_[id], query, open) < 1;
  });
}

}  // namespace isophote
