#pragma once

#include "isophote/derivatives/gather.h"
#include "isophote/integrate/far_light.h"

namespace isophote {

/// What a ray meets first, and the radiance of that, and of what lies behind in mirrors and glass, towards the ray's
/// origin: without light of directly sampled emitters that are met straight, and but for what media do on the way to
/// what is met first. `from` what is known, or from a path. `inside` is the absorption (1/m) of the solid that the ray
/// starts in; `depth` counts the scattering events before. Charged as a gather ray.
GatherSample meet(const World& world, const FarLight& from, const Ray& ray, const Rgb& inside, int depth,
                  Sampler& sampler, RayCounts& counts);

}  // namespace isophote
