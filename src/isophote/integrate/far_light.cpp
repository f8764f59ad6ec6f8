#include "isophote/integrate/far_light.h"

#include <cmath>

#include "isophote/integrate/shade.h"
#include "isophote/sampling/warp.h"
#include "isophote/trace/shadow.h"

namespace isophote {
namespace {

using Cell = IrradianceCells::Cell;

/// Samples of a cell up to which each reader adds one; from there on by a chance that falls with their number, so that
/// they grow as the root of how often the cell is read.
constexpr float enough = 16;
/// Samples of which some would have met what cuts their cell.
constexpr std::uint32_t telling = 64;

/// May something part a point of a cell from those of its samples? What cuts the plane that they lie in is met at once
/// by some of many rays that start there.
bool unsure(const IrradianceCells& cells, const Cell& cell, const Vec3& point) {
  const float edge = cells.edge(cell.key);
  const bool off_plane = std::abs(dot(point - cell.position, cell.normal)) > edge / 16;
  return cell.count < telling || cell.cut || cell.nearest < edge / 2 || off_plane;
}

bool open(const World& world, const Cell& cell, const Vec3& position, const Vec3& normal, RayCounts& counts) {
  return open_between(world, {cell.position, cell.normal}, {position, normal}, counts);
}

/// One sample of the irradiance at a point, with what it saw.
Cell traced(const World& world, const FarLight& from, const SurfacePoint& point, int depth, float survival,
            Sampler& sampler, RayCounts& counts) {
  Cell sample;
  sample.count = 1, sample.position = point.position, sample.normal = point.shading_normal;
  const Vec2 u = sampler.next2();
  if (!(sampler.next() < survival)) return sample;
  const Vec3 direction = Frame(point.shading_normal).to_world(cosine_hemisphere(u));
  if (!(dot(direction, point.geometric_normal) > 0)) return sample;
  const FirstPoint hit = first_point(world, {offset_origin(point, direction), direction}, false, sampler, counts.path,
                                     point.medium, FirstSegment::in_media, depth + 1);
  Rgb radiance = hit.emission;
  if (hit.point) {
    const Shaded light =
        shade(world, from, *hit.point, -hit.direction, hit.path_length, depth + 1 + hit.depth, sampler, counts);
    radiance += hit.throughput * (light.direct + light.indirect);
  }
  if (hit.medium_point) radiance += hit.throughput * path_radiance(world, hit, depth + 1 + hit.depth, sampler, counts);
  sample.nearest = hit.first_distance;
  sample.sum = radiance * (pi / survival);
  return sample;
}

}  // namespace

Rgb cell_irradiance(const World& world, const FarLight& from, const SurfacePoint& point, float distance, int depth,
                    float survival, Sampler& sampler, RayCounts& counts) {
  const std::uint64_t key = from.cells->key(point.position, point.shading_normal, distance);
  const Cell* const known = from.cells->find(key);
  const Cell* const own = from.left->find(key);
  const Cell* const like = known ? known : own;
  if (like && unsure(*from.cells, *like, point.position) &&
      !open(world, *like, point.position, point.shading_normal, counts)) {
    from.left->add({.key = key, .cut = true});
    return traced(world, from, point, depth, survival, sampler, counts).sum;
  }
  Rgb sum;
  float count = 0, weight = 0;
  for (const Cell* const cell : {known, own})
    if (cell) sum += cell->sum, weight += cell->weight, count += static_cast<float>(cell->count);
  if (count > 0 && sampler.next() * count >= enough) return sum / weight;
  Cell sample = traced(world, from, point, depth, survival, sampler, counts);
  const Rgb irradiance = sample.sum;
  sample.key = key, sample.weight = 1 + count, sample.sum = irradiance * sample.weight;
  from.left->add(sample);
  return irradiance;
}

void take_in(const World& world, IrradianceCells& cells, std::span<const IrradianceCells> left, RayCounts& counts) {
  const std::size_t known = cells.cells().size();
  for (const IrradianceCells& of_one : left)
    for (const Cell& more : of_one.cells()) {
      const Cell* const cell = cells.find(more.key);
      // Readers have asked cells that were known whether their samples lie in the open towards them.
      const bool fresh = cell && static_cast<std::size_t>(cell - cells.cells().data()) >= known;
      const bool blocked = fresh && !open(world, *cell, more.position, more.normal, counts);
      cells.add(blocked ? Cell{.key = more.key, .cut = true} : more);
    }
}

}  // namespace isophote
