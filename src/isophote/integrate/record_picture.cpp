#include "isophote/integrate/record_picture.h"

#include <algorithm>
#include <utility>

#include "isophote/cache/radiance_cache.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {
namespace {

constexpr float dot_radius = 1.6f, line_width = 1.2f;  // pixels
const Rgb grey(0.35f);  // of records of radiance, and of those in media where colours tell errors

/// What is drawn at one point of the picture.
class Marks {
 public:
  void take(const Site& record, const Sight& sight, const Rgb& colour) {
    if (dot(record.normal, sight.place.normal) < 0.5f) return;
    const OnScreen at = on_screen(record, sight);
    if (at.inside_rim < 0) return;
    if (at.from_centre < std::min(dot_radius, 0.5f * at.inside_rim)) dot_ = Rgb(1.0f);
    // Lines lie within the rims, where a record is sure to be visited.
    if (at.inside_rim < line_width) rim_ = colour;
  }
  std::optional<Rgb> shown() const { return dot_ ? dot_ : rim_; }  // dots lie over rims

 private:
  std::optional<Rgb> dot_, rim_;
};

std::vector<float> told_by_colour(const Job& job, std::span<const Record> records, RecordColour colour) {
  const ErrorModel model = job.method.error_model();
  std::vector<float> values;
  values.reserve(records.size());
  for (const Record& r : records)
    values.push_back(colour == RecordColour::radius ? semi_axes(r).mean() : predicted_error_at_rim(r, model));
  return values;
}

ColourScale scale_of(const RecordCache& cache, std::vector<float> values, RecordColour colour) {
  if (cache.volumes() && colour == RecordColour::radius)
    for (const VolumeCache* part : {&cache.volumes()->surfaces, &cache.volumes()->media})
      for (const VolumeRecord& r : part->records()) values.push_back(ball_radius(r.footprint));
  return colour_scale(std::move(values), true);
}

}  // namespace

ColouredPicture record_picture(const Job& job, const RecordCache& cache, RecordColour colour,
                               const std::optional<Plane>& slice) {
  const std::vector<float> values = told_by_colour(job, cache.records(), colour);
  const ColourScale scale = scale_of(cache, values, colour);
  const auto mark = [&](float, float, const std::optional<Sight>& sight) {
    Marks irradiance, radiance;
    if (!sight) return irradiance.shown();
    cache.visit_near(sight->place.position, [&](const Record& record) {
      irradiance.take(record, *sight, scale(values[static_cast<std::size_t>(&record - cache.records().data())]));
    });
    if (irradiance.shown() || !cache.radiance()) return irradiance.shown();
    cache.radiance()->visit_near(sight->place.position,
                                 [&](const RadianceRecord& record) { radiance.take(record, *sight, grey); });
    return radiance.shown();
  };
  std::optional<Plane> plane = plane_amid_records(job, cache);
  if (plane && slice) plane = slice;
  Screen screen;
  if (plane)
    screen = volume_slice(job, cache, *plane, [&](const VolumeRecord& record) {
      return colour == RecordColour::radius ? scale(ball_radius(record.footprint)) : grey;
    });
  return {marked_picture(job, cache, Window(job), mark, screen), scale, plane};
}

}  // namespace isophote
