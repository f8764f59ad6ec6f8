#pragma once

#include "isophote/cache/lobe.h"
#include "isophote/cache/record_cache.h"

namespace isophote {

/// Incident radiance by records, of which glossy lobes take what they reflect [Krivanek 2005a].
class RadianceCache : public RecordStore<RadianceRecord> {
 public:
  RadianceCache(const Box& bounds, Basis basis) : RecordStore(bounds), basis_(basis) {}

  Basis basis() const { return basis_; }

  /// Radiance reflected at the query towards the unit vector `towards` by a lobe of `order` bands, the mean over the
  /// records that serve it and have as many, and never negative; nothing where there is none. set_lobe(lobe, cosine)
  /// sets the coefficients of a lobe of that order for a viewer at that cosine.
  ///
  /// The query's normal and a record's may differ, by the surface's bend or by a normal map (query.facing). Frames are
  /// aligned so that the mirror direction, where the lobe is, keeps its place in the world: the record's lobe is that
  /// for the viewer who would see the same direction mirrored about the record's normal.
  template <class SetLobe>
  std::optional<Rgb> reflect(const Query& query, const Vec3& towards, int order, SetLobe&& set_lobe,
                             OpenTest open = {}) const;

  /// The same record by record: visit(id, error, weight, reflected), as in `visit_serving`; what is reflected may be
  /// negative.
  template <class SetLobe, class Visit>
  void visit_reflected(const Query& query, const Vec3& towards, int order, SetLobe&& set_lobe, OpenTest open,
                       Visit&& visit) const;

  /// Does any record of at least `order` bands serve?
  bool covers(const Query& query, int order, OpenTest open = {}) const {
    return any_serving(query, open, [&](const RadianceRecord& r) { return holds(r, order); });
  }

  static int bands(const RadianceRecord& record);
  /// Has it as many?
  static bool holds(const RadianceRecord& record, int order) {
    return record.jet.value.size() >= static_cast<std::size_t>(harmonics_count(order));
  }

 private:
  Basis basis_;
};

/// The product of a lobe with a record's radiance extrapolated to `across`, in the record's frame. It may be negative,
/// for want of the bands that are left out.
Rgb reflected(const RadianceRecord& record, Vec2 across, const TurnedLobe& lobe);

template <class SetLobe, class Visit>
void RadianceCache::visit_reflected(const Query& query, const Vec3& towards, int order, SetLobe&& set_lobe,
                                    OpenTest open, Visit&& visit) const {
  const Vec3 mirrored = query.facing * (2 * dot(query.facing, towards)) - towards;
  Frame frame{};
  std::optional<TurnedLobe> lobe;  // of records with this frame
  visit_serving(query, open, [&](std::uint32_t id, float error, float weight) {
    const RadianceRecord& record = records()[id];
    if (!holds(record, order)) return;
    if (!lobe || !(frame.n == record.normal)) {
      frame = Frame(record.normal);
      const Vec3 local = frame.to_local(mirrored);
      constexpr float least = 1e-3f;
      Lobe straight;
      straight.order = order;
      set_lobe(straight, std::clamp(local.z, least, 1.0f));
      lobe.emplace(straight, Vec2{-local.x, -local.y});
    }
    const Vec3 d = query.position - record.position;
    visit(id, error, weight, reflected(record, {dot(d, frame.u), dot(d, frame.v)}, *lobe));
  });
}

template <class SetLobe>
std::optional<Rgb> RadianceCache::reflect(const Query& query, const Vec3& towards, int order, SetLobe&& set_lobe,
                                          OpenTest open) const {
  float weights = 0;
  Rgb sum;
  visit_reflected(query, towards, order, set_lobe, open, [&](std::uint32_t, float, float weight, const Rgb& each) {
    sum += each * weight;
    weights += weight;
  });
  if (!(weights > 0)) return std::nullopt;
  return max(sum / weights, Rgb{});
}

}  // namespace isophote
