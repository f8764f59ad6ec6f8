#include "isophote/trace/medium_spans.h"

#include <algorithm>
#include <cmath>

#include "isophote/scene/density_grid.h"

namespace isophote {
namespace {

/// The part of the ray within a box: cuts near and far, whose normals it notes; false where nothing is left.
bool clip(const Box& box, Ray& ray, Vec3& near_normal, Vec3& far_normal) {
  for (int i = 0; i < 3; ++i) {
    if (ray.direction[i] == 0) {
      if (ray.origin[i] < box.lower[i] || ray.origin[i] > box.upper[i]) return false;
      continue;
    }
    const float a = (box.lower[i] - ray.origin[i]) / ray.direction[i];
    const float b = (box.upper[i] - ray.origin[i]) / ray.direction[i];
    Vec3 normal;
    normal[i] = 1;
    if (std::min(a, b) > ray.near) ray.near = std::min(a, b), near_normal = normal;
    if (std::max(a, b) < ray.far) ray.far = std::max(a, b), far_normal = normal;
  }
  return ray.near < ray.far;
}

/// A scene of the mesh alone, for a ray caster.
std::unique_ptr<Scene> scene_of(const ClosedMesh& mesh) {
  auto scene = std::make_unique<Scene>();
  scene->materials.emplace_back();
  Mesh& only = scene->meshes.emplace_back();
  only.positions = mesh.positions;
  only.triangles = mesh.triangles;
  return scene;
}

Box grid_box(const Medium& medium) {
  Box all;
  all.extend(Vec3(-infinity, -infinity, -infinity)), all.extend(Vec3(infinity, infinity, infinity));
  const auto* grid = std::get_if<GridDensity>(&medium.density);
  return grid ? (*grid)->world_bounds() : all;
}

}  // namespace

MediumBounds::MediumBounds(std::span<const Medium> media) {
  for (std::size_t i = 0; i < media.size(); ++i) {
    Bounds& bounds = all_.emplace_back();
    bounds.medium = static_cast<std::uint32_t>(i);
    bounds.box = grid_box(media[i]);
    Box own;
    if (const auto* mesh = std::get_if<ClosedMesh>(&media[i].bounds)) {
      for (const Vec3& p : mesh->positions) own.extend(p);
      bounds.mesh = scene_of(*mesh);
      bounds.rays = std::make_unique<RayCaster>(*bounds.mesh);
    } else {
      own = std::get<Box>(media[i].bounds);
    }
    bounds.box = {max(bounds.box.lower, own.lower), min(bounds.box.upper, own.upper)};
  }
}

MediumBounds::Crossings::Crossings(const Bounds& bounds, const Ray& ray) : bounds_(bounds), ray_(ray) {
  if (!clip(bounds.box, ray_, box_near_, box_far_)) ray_.near = ray_.far = 0;
  end_ = ray_.far;
  ray_.far = infinity;
}

bool MediumBounds::Crossings::next(MediumSpan& span) {
  span.medium = bounds_.medium;
  if (bounds_.rays) return next_of_mesh(span);
  if (!(ray_.near < end_)) return false;
  span.near = ray_.near, span.far = end_;
  span.near_normal = box_near_, span.far_normal = box_far_;
  ray_.near = end_;
  return true;
}

bool MediumBounds::Crossings::next_of_mesh(MediumSpan& span) {
  bool inside = false;
  span.near = ray_.near, span.near_normal = box_near_;
  while (ray_.near < end_) {
    Hit hit;
    if (!bounds_.rays->intersect(ray_, 0, hit)) break;
    const Mesh& mesh = bounds_.mesh->meshes.front();
    const auto& t = mesh.triangles[hit.triangle];
    const Vec3 &p = mesh.positions[t[0]], e1 = mesh.positions[t[1]] - p, e2 = mesh.positions[t[2]] - p;
    const Vec3 normal = cross(e1, e2);
    const bool leaves = dot(normal, ray_.direction) > 0;
    // Which side it starts on, the first crossing tells. Crossings that an edge doubles change nothing.
    if (first_) inside = leaves, first_ = false;
    ray_.near = std::nextafter(hit.distance, infinity);
    if (!leaves) {
      if (!inside) span.near = hit.distance, span.near_normal = normal, inside = true;
    } else if (inside) {
      span.far = std::min(hit.distance, end_);
      span.far_normal = hit.distance < end_ ? normal : box_far_;
      if (span.near < span.far) return true;
      inside = false;
    }
  }
  ray_.near = end_;
  span.far = end_, span.far_normal = box_far_;
  return inside && span.near < span.far;
}

}  // namespace isophote
