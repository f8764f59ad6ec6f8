// Rays per CPU second of path tracing, gathering and the final pass, and lookups and records, beside a bare Embree loop
// that casts the same kinds of rays and does nothing else. One thread, repeated in turn, medians. Prints JSON.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "isophote/integrate/build.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/pilot.h"
#include "isophote/integrate/render.h"
#include "isophote/load/scene_file.h"
#include "isophote/sampling/warp.h"

namespace isophote {
namespace {

/// The scene once more, with nothing of ours between the loop and Embree.
class BareScene {
 public:
  explicit BareScene(const Scene& scene) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const Mesh& mesh : scene.meshes) {
      const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), mesh.positions.size()));
      std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
      auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
      std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_);
  }
  ~BareScene() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  bool intersect(const Ray& ray, Vec3& normal, float& distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    normal = normalize(Vec3{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
    if (dot(normal, ray.direction) > 0) normal = -normal;
    distance = query.ray.tfar;
    return true;
  }
  bool occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embree_ray(ray);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
  }

 private:
  static RTCRay embree_ray(const Ray& ray) {
    const Vec3 &o = ray.origin, &d = ray.direction;
    return {o.x, o.y, o.z, ray.near, d.x, d.y, d.z, 0, ray.far, ~0u, 0, 0};
  }

  RTCDevice device_;
  RTCScene scene_;
};

/// Camera rays and cosine bounces from where they land, each followed by a shadow ray to a fixed point: as many of each
/// as a path has.
std::uint64_t bare_loop(const Job& job, const BareScene& bare, const Vec3& light, int bounces) {
  std::uint64_t rays = 0;
  const float offset = 1e-5f * job.world.rays.scene_scale();
  for (int y = 0; y < job.height; ++y)
    for (int x = 0; x < job.width; ++x) {
      Sampler stream = job.sampler(x, y, 0);
      Ray ray = job.camera_ray(x, y, stream);
      for (int i = 0; i <= bounces; ++i) {
        Vec3 normal;
        float distance = 0;
        ++rays;
        if (!bare.intersect(ray, normal, distance)) break;
        const Vec3 p = ray.origin + ray.direction * distance + normal * offset;
        const Vec3 to_light = light - p;
        const float far = length(to_light);
        ++rays;
        bare.occluded({p, to_light / far, 0, far});
        ray = {p, Frame(normal).to_world(cosine_hemisphere(stream.next2()))};
      }
    }
  return rays;
}

/// What the pixels ask the cache, in their order.
std::vector<Query> queries_of(const Job& job) {
  std::vector<Query> queries;
  RayCounts counts;
  for (int y = 0; y < job.height; ++y)
    for (int x = 0; x < job.width; ++x) {
      Sampler stream = job.sampler(x, y, 0);
      const FirstPoint seen = first_point(job.world, job.camera_ray(x, y, stream), true, stream, counts.camera);
      if (const auto place = place_of(job, seen)) queries.push_back(query_at(*place));
    }
  return queries;
}

struct Series {
  const char* name;
  std::function<std::uint64_t()> run;  // returns how many rays, lookups or records
  std::vector<double> rates;           // millions a CPU second
};

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

int run(const char* path, int repeats) {
  const LoadedScene loaded = load_scene(path, [](const std::string&) {});
  const RayCaster rays(loaded.scene);
  const Emitters emitters(loaded.scene);
  Job job{World{loaded.scene, rays, emitters}, loaded.scene.cameras.front()};
  job.width = job.height = 256;
  job.samples = 1;
  job.parallel = serial_for();
  job.method = find_method("cached");
  const BareScene bare(loaded.scene);
  const Box box = loaded.scene.bounds();
  const Vec3 light = box.center() + Vec3{0, 0.4f * box.size().y, 0};
  const float offset = 1e-5f * rays.scene_scale();
  RecordCache cache = empty_cache(job);
  const BuildReport built = build_in_rounds(job, cache);
  Job so_far = job;  // as it is when the last records are made
  so_far.pilot = built.pilot, so_far.method.secondary = built.seeding.chosen;
  const auto film_rays = [&](const RecordCache* from) {
    Film film(job.width, job.height);
    return render(job, from, film).rays.total();
  };
  const auto gather_rays = [&](const RecordCache* records, bool cells) {
    RayCounts counts;
    HemisphereGather scratch;
    IrradianceCells left;
    const FarLight from{records, cells ? &cache.cells() : nullptr, &left};
    for (std::size_t i = 0; i < cache.records().size(); i += cache.records().size() / 64 + 1) {
      left.clear();
      const Record& r = cache.records()[i];
      gather_hemisphere(job.world, from, {r.position, r.normal, r.normal, 0, offset}, job.strata, i, scratch, counts);
    }
    return counts.total();
  };
  const std::vector<Query> in_order = queries_of(job);
  std::vector<Query> at_random = in_order;
  std::shuffle(at_random.begin(), at_random.end(), std::mt19937());
  float sink = 0;
  const auto lookups = [&](const std::vector<Query>& queries) {
    for (const Query& q : queries) sink += cache.interpolate(q).value_or(Rgb{}).r;
    return queries.size();
  };
  const auto records = [&] {
    RayCounts counts;
    HemisphereGather scratch;
    IrradianceCells left;
    const std::vector<Place> places = random_places(so_far, counts);
    for (const Place& place : places) {
      left.clear();
      sink += make_records(so_far, cache, place, scratch, left, counts).irradiance->jet.value.r;
    }
    return places.size();
  };
  std::vector<Series> all{{"bare", [&] { return bare_loop(job, bare, light, 3); }, {}},
                          {"path", [&] { return film_rays(nullptr); }, {}},
                          {"gather_records", [&] { return gather_rays(&cache, true); }, {}},
                          {"gather_cells", [&] { return gather_rays(nullptr, true); }, {}},
                          {"gather_paths", [&] { return gather_rays(nullptr, false); }, {}},
                          {"final", [&] { return film_rays(&cache); }, {}},
                          {"lookup", [&] { return lookups(in_order); }, {}},
                          {"lookup_at_random", [&] { return lookups(at_random); }, {}},
                          {"record", records, {}}};
  const FlushDenormals flush;
  for (int i = 0; i < repeats; ++i)
    for (Series& s : all) {
      const Clock before = Clock::now();
      const std::uint64_t cast = s.run();
      s.rates.push_back(static_cast<double>(cast) / (Clock::now() - before).cpu / 1e6);
    }
  fmt::print("{{");
  for (const Series& s : all) {
    std::vector<double> ratios;
    for (int i = 0; i < repeats; ++i) ratios.push_back(s.rates[i] / all[0].rates[i]);
    fmt::print("{}\"{}\": {{\"millions_per_second\": {:.6g}, \"of_bare\": {:.6g}}}", &s == all.data() ? "" : ", ",
               s.name, median(s.rates), median(ratios));
  }
  fmt::print("}}\n");
  return sink >= 0 ? 0 : 1;  // which keeps lookups from being left out
}

}  // namespace
}  // namespace isophote

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_rays SCENE [REPEATS]\n");
    return 2;
  }
  return isophote::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 7);
}
