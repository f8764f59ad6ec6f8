#pragma once

#include <functional>
#include <optional>

#include "isophote/cache/record_cache.h"
#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// A part of the picture, enlarged to its size: (x, y), in pixels from the top left, is its middle.
struct Window {
  float x = 0, y = 0;
  float zoom = 1;

  /// The whole picture.
  explicit Window(const Job& job) : x(0.5f * static_cast<float>(job.width)), y(0.5f * static_cast<float>(job.height)) {}
};

/// A place as it is seen: from where light may have come through mirrors.
struct Sight {
  Place place;
  Vec3 direction;  ///< of the last segment
  float pixel;     ///< length that a pixel of the enlarged picture spans across `direction`
};

/// Where a sight lies against a record, in pixels of the enlarged picture.
struct OnScreen {
  float inside_rim;  ///< how far within the footprint; negative outside
  float from_centre;
};
OnScreen on_screen(const Site& record, const Sight& sight);

/// The irradiance of a cache, dimmed, with marks over it, meant for sRGB display without further exposure.
/// mark(x, y, sight) gives the colour at (x, y) of the whole picture, if anything is drawn there; there is no sight
/// where no record could be.
using Mark = std::function<std::optional<Rgb>(float x, float y, const std::optional<Sight>& sight)>;

/// What is seen at one point of the picture: a mark, or light that is dimmed as irradiance is, or black.
struct Shown {
  std::optional<Rgb> mark, light;
};
/// What hides surfaces and their marks along a ray of the camera, whose first surface of any kind is at the distance
/// `surface`, if anything does.
using Screen = std::function<std::optional<Shown>(const Ray& ray, float surface, RayCounts& counts)>;

RgbImage marked_picture(const Job& job, const RecordCache& cache, const Window& window, const Mark& mark,
                        const Screen& screen = {});

}  // namespace isophote
