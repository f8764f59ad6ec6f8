#include "isophote/integrate/marked_picture.h"

#include <cmath>

#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/shade.h"

namespace isophote {
namespace {

constexpr int subpixels = 2;             // along each axis: thin lines want smooth edges
constexpr float mean_luminance = 0.15f;  // of what is not black, beside marks of full brightness

/// A pixel's samples: those that show light, and those that are marked.
struct Mixture {
  Rgb light, marks;
  int lit = 0, marked = 0;
};

/// What all points of a picture are shown by.
struct Shows {
  const Job& job;
  const RecordCache& cache;
  const Window& window;
  const Mark& mark;
  const Screen& screen;

  Shown at(float x, float y, RayCounts& counts) const {
    Sampler stream = job.sampler(static_cast<int>(x), static_cast<int>(y), 0);
    const Ray ray = job.camera.ray(x, y, job.width, job.height);
    const FirstPoint seen = first_point(job.world.clear(), ray, true, stream, counts.camera);
    if (screen)
      if (const auto shown = screen(ray, seen.first_distance, counts)) return *shown;
    std::optional<Sight> sight;
    if (const auto place = wanted_place(job, seen)) sight = {*place, seen.direction, place->pixel / window.zoom};
    if (const auto colour = mark(x, y, sight)) return {colour, {}};
    if (!sight) return {};
    return {{}, cache.interpolate(query_at(*seen.point), LeakTest{job.world, counts})};
  }
};

}  // namespace

OnScreen on_screen(const Site& record, const Sight& sight) {
  const Vec3 q = sight.place.position - record.position, &d = sight.direction, &n = sight.place.geometric_normal;
  const float t = std::sqrt(quadratic_form(record.footprint.shape, q));
  const float from_centre = length(q - d * dot(q, d)) / sight.pixel;
  if (!(t > 0)) return {infinity, from_centre};
  // A step s across d leads along the surface to s - d (s . n) / (d . n): t changes by s . (g - n (g . d) / (d . n)).
  const Vec3 g = record.footprint.shape * q / t;
  const float slope = length(g - n * (dot(g, d) / dot(d, n))) * sight.pixel;
  return {slope > 0 ? (1 - t) / slope : infinity, from_centre};
}

RgbImage marked_picture(const Job& job, const RecordCache& cache, const Window& window, const Mark& mark,
                        const Screen& screen) {
  const Shows shows{job, cache, window, mark, screen};
  std::vector<Mixture> mixtures(static_cast<std::size_t>(job.width) * job.height);
  for_each(job.parallel, static_cast<std::size_t>(job.height), 1, [&](std::size_t row, RayCounts& counts) {
    for (int column = 0; column < job.width; ++column) {
      Mixture& mixture = mixtures[row * job.width + column];
      for (int s = 0; s < subpixels * subpixels; ++s) {
        const float u = static_cast<float>(column) + (static_cast<float>(s % subpixels) + 0.5f) / subpixels;
        const float v = static_cast<float>(row) + (static_cast<float>(s / subpixels) + 0.5f) / subpixels;
        const float x = window.x + (u - 0.5f * static_cast<float>(job.width)) / window.zoom;
        const float y = window.y + (v - 0.5f * static_cast<float>(job.height)) / window.zoom;
        const Shown shown = shows.at(x, y, counts);
        if (shown.mark)
          mixture.marks += *shown.mark, ++mixture.marked;
        else if (shown.light)
          mixture.light += *shown.light, ++mixture.lit;
      }
    }
  });
  double sum = 0, count = 1e-30;
  for (const Mixture& m : mixtures)
    if (m.lit > 0) sum += luminance(m.light) / static_cast<float>(m.lit), ++count;
  const auto dim = static_cast<float>(sum > 0 ? mean_luminance * count / sum : 0);
  RgbImage picture(job.width, job.height);
  constexpr float samples = subpixels * subpixels;
  for (std::size_t i = 0; i < mixtures.size(); ++i) {
    const Mixture& m = mixtures[i];
    picture.pixels[i] = m.marks / samples;
    // Samples that show nothing leave the others' light as it is, but at the edge of what there is to see.
    if (m.lit > 0)
      picture.pixels[i] +=
          m.light * (dim * (samples - static_cast<float>(m.marked)) / samples / static_cast<float>(m.lit));
  }
  return picture;
}

}  // namespace isophote
