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
void settle_raised(Record& record, const SettleRule& rule) {
  const float natural = record.footprint.unscaled * rule.scale, radius = record.footprint.radius;
  limit_extrapolation(record, natural);
  if (!(natural < radius)) return;
  const float height = 1 / std::sqrt(quadratic_form(record.footprint.shape, record.normal));
  record.footprint.flatten(record.normal, std::min(height, std::max(natural, least_height * radius)));
}

void shrink(Record& record, float unscaled, const SettleRule& rule) {
  record.footprint.unscaled = unscaled;
  record.footprint.resize(unscaled * rule.scale);
}

/// A fresh record takes its own limit from all its neighbours first, and then limits them: among records that face
/// alike the outcome is the largest radii that keep the bound, whatever the order.
void clamp_to_neighbours(const Settling& settling, std::uint32_t fresh, const SettleRule& rule) {
  const auto& [records, neighbours] = settling;
  Record& record = records[fresh];
  const float unscaled = record.footprint.unscaled;
  const float limit = neighbours.limit(records, record.position, record.normal, unscaled, rule.slope);
  if (limit < unscaled) shrink(record, limit, rule);
  neighbours.insert(records);
  for (const std::uint32_t id : neighbours.limited(records, record, rule.slope)) {
    Record& other = records[id];
    shrink(other, record.footprint.unscaled + rule.slope * length(other.position - record.position), rule);
    settle_raised(other, rule);
    neighbours.lowered(records, id);
  }
}

}  // namespace

void settle(const Settling& settling, std::span<const std::uint32_t> fresh, const SettleRule& rule) {
  for (const std::uint32_t id : fresh) {
    if (rule.slope > 0) {
      while (settling.neighbours.size() < id) settling.neighbours.insert(settling.records);
      clamp_to_neighbours(settling, id, rule);
    }
    settle_raised(settling.records[id], rule);
  }
}

}  // namespace isophote
