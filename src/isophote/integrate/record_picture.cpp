#include "isophote/integrate/record_picture.h"

#include <algorithm>

#include "isophote/cache/radiance_cache.h"
#include "isophote/integrate/marked_picture.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {
namespace {

constexpr float dot_radius = 1.6f, line_width = 1.2f;  // pixels
const Rgb grey(0.35f);                                 // of records of radiance

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

}  // namespace

ColouredPicture record_picture(const Job& job, const RecordCache& cache, RecordColour colour) {
  const std::vector<float> values = told_by_colour(job, cache.records(), colour);
  const ColourScale scale = colour_scale(values, true);
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
  return {marked_picture(job, cache, Window(job), mark), scale};
}

}  // namespace isophote
