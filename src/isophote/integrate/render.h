#pragma once

#include "isophote/integrate/film.h"
#include "isophote/integrate/job.h"
#include "isophote/integrate/pilot.h"

namespace isophote {

class RecordCache;

/// What the final pass took.
struct RenderReport {
  RayCounts rays;
  /// Samples for which, behind glossy surfaces too, a record was missing: a path went on instead, or, after the host
  /// cancelled, the sample was left out.
  std::uint64_t uncovered = 0;
  bool cancelled = false;
};

/// Renders all samples: by path tracing where `cache` is null, else by reading it. If the host cancels, rows without a
/// sample get one, of what is covered.
RenderReport render(const Job& job, const RecordCache* cache, Film& film);

/// What a pixel shows, W/m2/sr, split as the layers of the picture are.
struct Radiance {
  Rgb direct, indirect;
};
/// The mean of all samples of one pixel, as `render` makes them.
Radiance pixel_radiance(const Job& job, const RecordCache& cache, int x, int y);

/// The picture as far as `cache` covers it, one sample in every stride x stride pixels: a preview while the cache is
/// built.
RgbImage coarse_picture(const Job& job, const RecordCache& cache, int stride);

/// Ward's own order [Ward, Rubinstein, Clear 1988]: one pass, scanline by scanline, on one thread; a sample that no
/// record serves adds a record at once, and each sample uses the records that exist then. `build` receives the time and
/// rays spent on records.
struct LazyReport {
  RenderReport final;
  RayCounts build_rays;
  Pilot pilot{};
  Seeding seeding{};
  Clock build;
};
LazyReport render_lazily(const Job& job, RecordCache& cache, Film& film);

}  // namespace isophote
