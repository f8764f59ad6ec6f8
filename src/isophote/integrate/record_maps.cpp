#include "isophote/integrate/record_maps.h"

#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/validity/semi_axes.h"

namespace isophote {

float predicted_error_at(const RecordCache& cache, const Query& query, OpenTest open, const ErrorModel& model) {
  float sum = 0, weights = 0;
  cache.visit_serving(query, open, [&](std::uint32_t id, float, float weight) {
    const Record& record = cache.records()[id];
    sum += predicted_error(record, query.position - record.position, query.normal, model) * weight;
    weights += weight;
  });
  return weights > 0 ? sum / weights : 0;
}

float record_density(const RecordCache& cache, const Query& query, OpenTest open) {
  float density = 0;
  cache.visit_serving(query, open, [&](std::uint32_t id, float error, float) {
    const SemiAxes axes = semi_axes(cache.records()[id]);
    density += 3 * (1 - error) / (pi * axes.longer * axes.shorter);
  });
  return density;
}

RecordMaps record_maps(const Job& job, const RecordCache& cache, RayCounts& rays) {
  const std::size_t pixels = static_cast<std::size_t>(job.width) * job.height;
  RecordMaps maps{std::vector<float>(pixels), std::vector<float>(pixels)};
  const ErrorModel model = job.method.error_model();
  rays += for_each(job.parallel, static_cast<std::size_t>(job.height), 1, [&](std::size_t y, RayCounts& counts) {
    for (int x = 0; x < job.width; ++x) {
      Sampler stream = job.sampler(x, static_cast<int>(y), 0);
      const Ray ray = job.camera_ray(x, static_cast<int>(y), stream);
      const auto place = place_of(job, first_point(job.world.clear(), ray, true, stream, counts.camera));
      if (!place) continue;
      const Query query = query_at(*place);
      const LeakTest open{job.world, counts};
      maps.error[y * job.width + x] = predicted_error_at(cache, query, open, model);
      maps.density[y * job.width + x] = record_density(cache, query, open);
    }
  });
  return maps;
}

}  // namespace isophote
