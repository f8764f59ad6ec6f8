#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "isophote/apps/explanation_text.h"
#include "isophote/integrate/explain_picture.h"

namespace isophote::app {
namespace {

using Json = nlohmann::ordered_json;

Json of(const Vec3& v) { return {v.x, v.y, v.z}; }
Json of(const Rgb& c) { return {c.r, c.g, c.b}; }
float degrees(float radians) { return radians * (180 / pi); }

Json of(const Reach& r) {
  return {{"semi_axes", {r.axes.longer, r.axes.shorter}},
          {"axis", of(r.axes.axis)},
          {"height", r.axes.height},
          {"metric_radius", r.natural},
          {"less_by_gradient", r.gradient},
          {"less_by_neighbours", r.neighbours},
          {"raised", r.raised},
          {"lowered", r.lowered},
          {"gradient_kept", r.gradient_kept},
          {"curvature_kept", r.curvature_kept}};
}

Json of(const ServingRecord& s) {
  return {{"record", s.id},
          {"position", of(s.position)},
          {"distance", s.distance},
          {"normal_angle", degrees(s.angle)},
          {"footprint_error", s.footprint_error},
          {"weight", s.weight},
          {"share", s.share},
          {"value", of(s.value)},
          {"extrapolated", of(s.extrapolated)},
          {"predicted_error", s.predicted_error},
          {"leak_tested", s.tested},
          {"reach", of(s.reach)}};
}

Json of(const NearMiss& m) {
  return {{"record", m.id},
          {"why", words_of(m.why).key},
          {"distance", m.distance},
          {"over_rim", m.rim},
          {"normal_angle", degrees(m.angle)}};
}

/// null where the pixel sees no surface but mirrors and glass.
Json surface(const Scene& scene, const Explanation& e) {
  if (!e.seen.point) return nullptr;
  const SurfacePoint& point = *e.seen.point;
  const Mesh& mesh = scene.meshes[point.mesh];
  return {{"mesh", mesh.name},
          {"material", scene.materials[static_cast<std::size_t>(mesh.material)].name},
          {"position", of(point.position)},
          {"normal", of(point.shading_normal)},
          {"mapped_normal", of(point.bsdf.frame.n)},
          {"path_length", e.seen.path_length},
          {"depth", e.depth},
          {"specular_events", e.seen.depth}};
}

template <class R>
Json list(const std::vector<R>& records) {
  Json all = Json::array();
  for (const R& record : records) all.push_back(of(record));
  return all;
}

}  // namespace

void print_explanation_json(const ExplainedPixel& pixel, const Explanation& e) {
  const Job& job = pixel.job;
  const Json json{{"pixel", {pixel.x, pixel.y}},
                  {"size", {job.width, job.height}},
                  {"method", job.method.name},
                  {"records", pixel.cache.records().size()},
                  {"surface", surface(job.world.scene, e)},
                  {"reads_cache", e.reads_cache},
                  {"radiance", {{"direct", of(e.mean.direct)}, {"indirect", of(e.mean.indirect)}}},
                  {"irradiance", e.irradiance ? of(*e.irradiance) : Json(nullptr)},
                  {"predicted_error", e.predicted_error},
                  {"serving", list(e.serving)},
                  {"near_misses", list(e.near_misses)}};
  fmt::print("{}\n", json.dump(2));
}

}  // namespace isophote::app
