#include "isophote/validity/settle.h"

#include <algorithm>
#include <cmath>

#include "isophote/validity/limit_extrapolation.h"

namespace isophote {
namespace {

/// Of a raised radius, what its height over and under the surface keeps at least: enough for uneven ground.
constexpr float least_height = 0.25f;

/// Where a lower bound has raised the radius above what the metric alone would give, the record reaches further along
/// its surface only: what lies above, on a step or a table, may be lit quite otherwise.
template <class R>
void settle_raised(R& record, const SettleRule& rule) {
  const float natural = record.footprint.unscaled * rule.scale, radius = record.footprint.radius;
  limit_extrapolation(record, natural);
  if (!(natural < radius)) return;
  const float height = 1 / std::sqrt(quadratic_form(record.footprint.shape, record.normal));
  record.footprint.flatten(record.normal, std::min(height, std::max(natural, least_height * radius)));
}

/// In media there is no surface to stay with.
void settle_raised(VolumeRecord& record, const SettleRule&) { limit_extrapolation(record); }

void shrink(Site& record, float unscaled, const SettleRule& rule) {
  record.footprint.unscaled = unscaled;
  record.footprint.resize(unscaled * rule.scale);
}

/// A fresh record takes its own limit from all its neighbours first, and then limits them: among records that face
/// alike the outcome is the largest radii that keep the bound, whatever the order.
template <class R>
void clamp_to_neighbours(const SettlingOf<R>& settling, std::uint32_t fresh, const SettleRule& rule) {
  const auto& [records, neighbours] = settling;
  R& record = records[fresh];
  const float limit = neighbours.limit(record, rule.slope);
  if (limit < record.footprint.unscaled) shrink(record, limit, rule);
  neighbours.insert(record);
  for (const std::uint32_t id : neighbours.limited(record, rule.slope)) {
    R& other = records[id];
    shrink(other, record.footprint.unscaled + rule.slope * length(other.position - record.position), rule);
    settle_raised(other, rule);
    neighbours.lower(id, other.footprint.unscaled);
  }
}

}  // namespace

template <class R>
void settle(const SettlingOf<R>& settling, std::span<const std::uint32_t> fresh, const SettleRule& rule) {
  for (const std::uint32_t id : fresh) {
    if (rule.slope > 0) {
      while (settling.neighbours.size() < id) settling.neighbours.insert(settling.records[settling.neighbours.size()]);
      clamp_to_neighbours(settling, id, rule);
    }
    settle_raised(settling.records[id], rule);
  }
}

template void settle(const SettlingOf<Record>&, std::span<const std::uint32_t>, const SettleRule&);
template void settle(const SettlingOf<RadianceRecord>&, std::span<const std::uint32_t>, const SettleRule&);
template void settle(const SettlingOf<VolumeRecord>&, std::span<const std::uint32_t>, const SettleRule&);

}  // namespace isophote
