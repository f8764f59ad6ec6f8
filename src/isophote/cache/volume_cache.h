#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "isophote/cache/record_cache.h"
#include "isophote/validity/volume_record.h"

namespace isophote {

/// A place that asks for the light scattered there. Records serve it whose media are the same.
struct VolumeQuery {
  Vec3 position;
  std::uint32_t media = 0;  ///< bit i: the bounds of the i-th medium hold it
};
using VolumeOpenTest = OpenTestOf<VolumeQuery>;

/// A phase function towards one viewer, as a function of where the light comes from: coefficients of spherical
/// harmonics by `harmonic_index`. Its product with incident radiance, summed over all, is the radiance scattered
/// towards the viewer per length and unit of sigma_s. Those of fewer bands are the first of them.
inline constexpr int most_volume_bands = 10;
using PhaseLobe = std::array<float, harmonics_count(most_volume_bands)>;

/// That of [Henyey, Greenstein 1941] with the mean cosine g, in `order` bands: g^l Y_lm(-wo). The light leaves along
/// `wo`, unit: against a ray from the eye.
PhaseLobe phase_lobe(float g, const Vec3& wo, int order);

/// How many bands hold that phase function but for 5 % of its root mean square. From |g| = 0.665 on they would be more
/// than `most_volume_bands`, which is the answer then.
int bands_for(float g);
/// Are they not, so that `bands_for` is all there is to it?
bool bands_hold(float g);

/// Radiance that arrives in media, by records, of which phase functions take what they scatter [Jarosz 2008a].
class VolumeCache : public RecordStore<VolumeRecord, VolumeQuery> {
 public:
  using RecordStore::RecordStore;

  std::uint32_t insert(VolumeRecord record);

  /// Radiance scattered at the query per length and unit of sigma_s by a lobe of `order` bands, W/m2/sr: the mean over
  /// the records that serve it and have as many, never negative; nothing where there is none.
  ///
  /// A record whose footprint says so counts in logarithms, which makes the mean over those a geometric one, in each
  /// channel that is not next to nothing: over 1e-6 of the mean of all records. There an exponent of the extrapolation
  /// is at most 2 either way.
  std::optional<Rgb> scattered(const VolumeQuery& query, std::span<const float> lobe, int order,
                               VolumeOpenTest open = {}) const;

  /// Does any record of at least `order` bands serve?
  bool covers(const VolumeQuery& query, int order, VolumeOpenTest open = {}) const {
    return any_serving(query, open, [&](const VolumeRecord& r) { return holds(r, order); });
  }

  static int bands(const VolumeRecord& record) {
    return static_cast<int>(std::lround(std::sqrt(static_cast<float>(record.jet.value.size()))));
  }
  /// Has it as many?
  static bool holds(const VolumeRecord& record, int order) {
    return record.jet.value.size() >= static_cast<std::size_t>(harmonics_count(order));
  }
  /// The mean of `mean_over_directions` over all records.
  double mean() const { return records().empty() ? 0 : sum_ / static_cast<double>(records().size()); }

 private:
  double sum_ = 0;
};

/// Single scattering of the light of surfaces and the sky, and multiple scattering: each with records of its own, for
/// they change over other lengths.
struct VolumeCaches {
  VolumeCache surfaces, media;

  explicit VolumeCaches(const Box& bounds) : surfaces(bounds), media(bounds) {}

  const VolumeCache& of(VolumePart part) const { return part == VolumePart::surfaces ? surfaces : media; }
  VolumeCache& of(VolumePart part) { return part == VolumePart::surfaces ? surfaces : media; }
};

/// The error of using `record` for the query, as its footprint measures it: under 1 inside. Infinite where the media
/// differ, and where the record saw a surface no farther than the query lies, or little more, and `open` finds one
/// between.
float serving_error(const VolumeRecord& record, const VolumeQuery& query, VolumeOpenTest open);

/// What a lobe takes of a record's radiance, and by how much that changes up to position + d.
struct Extrapolated {
  Rgb value, change;
};
Extrapolated extrapolate(const VolumeRecord& record, const Vec3& d, std::span<const float> lobe, int order);

}  // namespace isophote
