#include "isophote/trace/ray_caster.h"

#include <embree3/rtcore.h>
#include <xmmintrin.h>

#include <bit>
#include <cstring>
#include <string>

#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/trace/density_walk.h"

namespace isophote {
namespace {

struct Context {
  RTCIntersectContext embree;  // first: filters are handed a pointer to it
  std::uint32_t seed = 0;
};

/// Rejects hits where an alpha-masked or blended surface lets the ray through.
void filter(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] != -1) return;
  const auto& scene = *static_cast<const Scene*>(args->geometryUserPtr);
  const auto& context = *reinterpret_cast<const Context*>(args->context);
  const Hit hit{RTCHitN_geomID(args->hit, 1, 0), RTCHitN_primID(args->hit, 1, 0), RTCHitN_u(args->hit, 1, 0),
                RTCHitN_v(args->hit, 1, 0), 0};
  const float alpha = opacity(scene, hit);
  if (alpha >= 1) return;
  // The place is told by its barycentric coordinates, which do not depend on the units of the scene.
  const std::uint64_t bits = hash(context.seed, hit.mesh, hit.triangle, std::bit_cast<std::uint32_t>(hit.u),
                                  std::bit_cast<std::uint32_t>(hit.v));
  if (!(unit_float(static_cast<std::uint32_t>(bits >> 32)) < alpha)) args->valid[0] = 0;
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = ray.near, r.tfar = ray.far;
  r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
  return r;
}

Context make_context(std::uint32_t seed) {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.seed = seed;
  return context;
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float scale = 1;
  bool sheets = false;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void check() const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw UserError(error == RTC_ERROR_OUT_OF_MEMORY
                        ? "the scene's acceleration structure does not fit in memory"
                        : "the ray tracer failed to start, error " + std::to_string(error));
  }
  void add(const Scene& what, unsigned id);
};

void RayCaster::Impl::add(const Scene& what, unsigned id) {
  const Mesh& mesh = what.meshes[id];
  if (mesh.triangles.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  // Positions are copied, not shared: Embree reads 16 bytes at each, past the end of the array at the last one.
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                            mesh.positions.size());
  if (positions) std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  if (what.materials[mesh.material].alpha != Alpha::opaque) {
    rtcSetGeometryUserData(geometry, const_cast<Scene*>(&what));
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcSetGeometryOccludedFilterFunction(geometry, filter);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
  check();
}

RayCaster::RayCaster(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  impl_->check();
  impl_->scene = rtcNewScene(impl_->device);
  impl_->check();
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
  for (unsigned id = 0; id < scene.meshes.size(); ++id) impl_->add(scene, id);
  rtcCommitScene(impl_->scene);
  impl_->check();
  Box bounds = scene.bounds();
  if (bounds.empty())
    for (const Medium& medium : scene.media)
      bounds.extend(box_about(medium).lower), bounds.extend(box_about(medium).upper);
  if (!bounds.empty()) impl_->scale = bounds.diagonal();
  for (const Material& material : scene.materials) impl_->sheets |= material.transmission > 0 && !material.solid;
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

bool RayCaster::intersect(const Ray& ray, std::uint32_t seed, Hit& hit) const {
  Context context = make_context(seed);
  RTCRayHit query;
  query.ray = embree_ray(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = {query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
  return true;
}

bool RayCaster::occluded(const Ray& ray, std::uint32_t seed) const {
  Context context = make_context(seed);
  RTCRay query = embree_ray(ray);
  rtcOccluded1(impl_->scene, &context.embree, &query);
  return query.tfar < 0;
}

float RayCaster::scene_scale() const { return impl_->scale; }
bool RayCaster::has_sheets() const { return impl_->sheets; }

namespace {
constexpr unsigned flush_and_daz = 0x8040;  // results and operands, of the SSE control register
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | flush_and_daz); }
FlushDenormals::~FlushDenormals() { _mm_setcsr((_mm_getcsr() & ~flush_and_daz) | (saved_ & flush_and_daz)); }

}  // namespace isophote
