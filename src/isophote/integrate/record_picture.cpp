#include "isophote/integrate/record_picture.h"

#include <algorithm>

#include "isophote/integrate/marked_picture.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {
namespace {

constexpr float dot_radius = 1.6f, line_width = 1.2f;  // pixels

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
    std::optional<Rgb> rim, dot_colour;
    if (!sight) return rim;
    cache.visit_near(sight->place.position, [&](const Record& record) {
      if (dot(record.normal, sight->place.normal) < 0.5f) return;
      const OnScreen at = on_screen(record, *sight);
      if (at.inside_rim < 0) return;
      if (at.from_centre < std::min(dot_radius, 0.5f * at.inside_rim)) dot_colour = Rgb(1.0f);
      // Lines lie within the rims, where a record is sure to be visited.
      if (at.inside_rim < line_width) rim = scale(values[static_cast<std::size_t>(&record - cache.records().data())]);
    });
    return dot_colour ? dot_colour : rim;  // dots lie over rims
  };
  return {marked_picture(job, cache, Window(job), mark), scale};
}

}  // namespace isophote
