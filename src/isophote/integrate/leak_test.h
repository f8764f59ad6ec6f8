#pragma once

#include "isophote/cache/volume_cache.h"
#include "isophote/trace/shadow.h"

namespace isophote {

/// Answers the cache whether a record that saw something near lies in the open towards a query, by one ray. Lives no
/// longer than `world` and `counts`.
struct LeakTest {
  const World& world;
  RayCounts& counts;

  bool operator()(const Site& record, const Query& query) const {
    return open_between(world, {record.position, record.normal}, {query.position, query.normal}, counts);
  }
  bool operator()(const Site& record, const VolumeQuery& query) const {
    return open_between(world, record.position, query.position, counts);
  }
};

}  // namespace isophote
