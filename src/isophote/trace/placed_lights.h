#pragma once

#include "isophote/trace/path.h"

namespace isophote {

/// How light changes while the places that scatter it stay.
struct LightChange {
  Gradient<Rgb> turn;     ///< over directions from the ray's origin to them, on the unit sphere
  Gradient<Rgb> passage;  ///< by what media leave of it on the way, as the origin moves, 1/m
};

/// Light of point and spot lights that media scatter once along a ray, towards its origin. Their light falls off with
/// the square of the distance, so that collisions, which know nothing of it, would find it with a variance without
/// bounds: places are chosen by the angle under which the light sees the ray [Kulla, Fajardo 2012], within its cone.
/// `inside` is the absorption (1/m) of the solid that the ray runs in. The world has media. Unbiased.
/// `change`, if given, is increased by its own; what passes on the way is then exact, not by ratio tracking.
Rgb placed_lights_along(const World& world, const Ray& ray, const Rgb& inside, Sampler& sampler, RayCounts& counts,
                        LightChange* change = nullptr);

}  // namespace isophote
