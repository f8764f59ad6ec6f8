#include "isophote/integrate/explain.h"

#include <algorithm>
#include <cmath>

#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

constexpr float about_equal = 1e-4f;  // relative: radii differ by rounding where nothing has changed them
constexpr std::size_t most_near_misses = 4;
constexpr float near_rim = 1.5f;  // how far out a record counts as one that nearly served

float angle_between(const Vec3& a, const Vec3& b) { return 2 * std::asin(std::min(1.0f, length(a - b) / 2)); }

/// Tells how records came to their radii, by asking their method again.
class Reaches {
 public:
  explicit Reaches(const Job& job) : method_(job.method), scale_(job.method.error_model().scale) {
    view_.scene_scale = job.world.rays.scene_scale();
    view_.pilot = job.pilot;
  }

  /// `jet` is what the metric saw when it decided the record's footprint.
  Reach operator()(const Record& record, const Jet<Rgb>& jet) const {
    const float radius = record.footprint.radius, unscaled = record.footprint.unscaled;
    const int order = record.footprint.order;
    Reach reach{.axes = semi_axes(record)};
    const float alone = wanted(record.normal, jet, {});
    const float by_gradient = wanted(record.normal, jet, {.gradient = method_.settings.bounds.gradient});
    reach.natural = alone * scale_;
    reach.gradient = by_gradient < alone * (1 - about_equal);
    reach.neighbours = method_.settings.bounds.neighbours > 0 && unscaled < by_gradient * (1 - about_equal);
    reach.raised = radius > unscaled * scale_ * (1 + about_equal);
    reach.lowered = radius < unscaled * scale_ * (1 - about_equal);
    reach.gradient_kept = order > 0 ? record.gradient_scale : 0;
    reach.curvature_kept = order > 1 ? 2 * luminance(record.jet.value) * record.curvature_scale : 0;
    return reach;
  }

 private:
  /// The unscaled radius under these bounds; the view matters to others alone.
  float wanted(const Vec3& normal, const Jet<Rgb>& jet, const RadiusBounds& bounds) const {
    View view = view_;
    view.normal = normal;
    MetricSettings settings = method_.settings;
    settings.bounds = bounds;
    return method_.metric->measure(jet, view, settings).unscaled;
  }

  const Method& method_;
  float scale_;
  View view_;
};

void add_serving(const Job& job, const RecordCache& cache, const RecordCache& built, const Query& query, OpenTest open,
                 Explanation& e) {
  const Reaches reaches(job);
  const ErrorModel model = job.method.error_model();
  float weights = 0;
  cache.visit_serving(query, open, [&](std::uint32_t id, float error, float weight) {
    const Record& record = cache.records()[id];
    const Vec3 q = query.position - record.position;
    ServingRecord& s = e.serving.emplace_back();
    s.id = id;
    s.position = record.position;
    s.distance = length(q);
    s.angle = angle_between(query.normal, record.normal);
    s.footprint_error = error;
    s.weight = weight;
    s.value = record.jet.value;
    s.extrapolated = record.extrapolate(q, query.facing);
    s.predicted_error = predicted_error(record, q, query.normal, model);
    s.tested = record.jet.distances.obstacles.before(q, record.normal);
    s.reach = reaches(record, built.records()[id].jet);
    weights += weight;
  });
  for (ServingRecord& s : e.serving) {
    s.share = s.weight / weights;
    e.predicted_error += s.share * s.predicted_error;
  }
  std::stable_sort(e.serving.begin(), e.serving.end(),
                   [](const ServingRecord& a, const ServingRecord& b) { return a.share > b.share; });
}

void add_near_misses(const RecordCache& cache, const Query& query, OpenTest open, Explanation& e) {
  for (std::uint32_t id = 0; id < cache.records().size(); ++id) {
    const Record& record = cache.records()[id];
    const Vec3 q = query.position - record.position;
    const float rim = std::sqrt(quadratic_form(record.footprint.shape, q));
    const Standing why = standing(record, query, open);
    if (why == Standing::serves || !(rim < near_rim)) continue;
    if (why == Standing::beyond_rim && dot(record.normal, query.normal) <= 0) continue;
    e.near_misses.push_back({id, why, length(q), angle_between(query.normal, record.normal), rim});
  }
  std::stable_sort(e.near_misses.begin(), e.near_misses.end(),
                   [](const NearMiss& a, const NearMiss& b) { return a.rim < b.rim; });
  if (e.near_misses.size() > most_near_misses) e.near_misses.resize(most_near_misses);
}

}  // namespace

Explanation explain(const Job& job, const RecordCache& cache, int x, int y, const RecordCache* built) {
  Explanation e;
  RayCounts counts;
  const FlushDenormals flush;
  Sampler stream = job.sampler(x, y, 0);
  const Ray ray = job.camera_ray(x, y, stream);
  e.seen = first_point(job.world.clear(), ray, true, stream, counts.camera);
  e.depth = e.seen.first_distance * dot(ray.direction, job.camera.forward);
  e.mean = pixel_radiance(job, cache, x, y);
  e.reads_cache = place_of(job, e.seen).has_value();
  if (!e.reads_cache) return e;
  const Query query = query_at(*e.seen.point);
  e.normal = query.normal;
  const LeakTest open{job.world, counts};
  e.irradiance = cache.interpolate(query, open);
  add_serving(job, cache, built ? *built : cache, query, open, e);
  add_near_misses(cache, query, open, e);
  return e;
}

}  // namespace isophote
