#include "isophote/integrate/record_picture.h"

#include <algorithm>
#include <cmath>

#include "isophote/image/false_colour.h"
#include "isophote/integrate/build.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

/// Radii of the 5th and 95th percentile, as logarithms: the ends of the colour scale.
struct RadiusScale {
  float low = 0, high = 1;

  explicit RadiusScale(std::span<const Record> records) {
    std::vector<float> radii;
    for (const Record& r : records) radii.push_back(std::log(r.footprint.radius));
    if (radii.empty()) return;
    std::sort(radii.begin(), radii.end());
    low = radii[radii.size() / 20];
    high = std::max(radii[radii.size() - 1 - radii.size() / 20], low + 1e-3f);
  }
  Rgb color(float radius) const {
    return false_colour(std::clamp((std::log(radius) - low) / (high - low), 0.0f, 1.0f));
  }
};

/// The colour of a dot or rim at this place, if one is drawn there; dots lie over rims.
std::optional<Rgb> mark(const RecordCache& cache, const Place& place, const RadiusScale& scale) {
  std::optional<Rgb> rim, dot_color;
  cache.visit_near(place.position, [&](const Record& record) {
    if (dot(record.normal, place.normal) < 0.5f) return;
    const Vec3 q = place.position - record.position;
    const float distance = length(q), radius = record.footprint.radius;
    if (distance < 1.6f * place.pixel) dot_color = Rgb(1.0f);
    const float from_rim = std::abs(std::sqrt(quadratic_form(record.footprint.shape, q)) - 1) * radius;
    if (from_rim < 0.6f * place.pixel) rim = scale.color(radius);
  });
  return dot_color ? dot_color : rim;
}

}  // namespace

RgbImage record_picture(const Job& job, const RecordCache& cache) {
  const RadiusScale scale(cache.records());
  RgbImage picture(job.width, job.height);
  std::vector<char> marked(picture.pixels.size());
  for_each(job.parallel, static_cast<std::size_t>(job.height), 1, [&](std::size_t y, RayCounts& counts) {
    for (int x = 0; x < job.width; ++x) {
      const auto i = y * job.width + x;
      Sampler stream = job.sampler(x, static_cast<int>(y), 0);
      const FirstPoint seen =
          first_point(job.world, job.camera_ray(x, static_cast<int>(y), stream), true, stream, counts.camera);
      const std::optional<Place> place = place_of(job, seen);
      if (!place) continue;
      const auto line = mark(cache, *place, scale);
      marked[i] = line.has_value();
      picture.pixels[i] =
          line ? *line : cache.interpolate(query_at(*seen.point), LeakTest{job.world, counts}).value_or(Rgb{});
    }
  });
  double sum = 0, count = 1e-30;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (!marked[i] && !is_black(picture.pixels[i])) sum += luminance(picture.pixels[i]), ++count;
  const auto dim = static_cast<float>(sum > 0 ? 0.15 * count / sum : 0);
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (!marked[i]) picture.pixels[i] *= dim;
  return picture;
}

}  // namespace isophote
