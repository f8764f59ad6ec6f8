#pragma once

#include "isophote/derivatives/gather.h"
#include "isophote/derivatives/jet.h"
#include "isophote/derivatives/wall_distance.h"

namespace isophote {

/// Irradiance with gradients that know of media and occlusion [Jarosz 2008b]: the gather's layers are stratified
/// hemispheres one in another, over whose walls radiance steps at the depth of each, and light changes on its way as
/// the record moves. Rotational gradient of the total radiance, with exact stratum weights. Without layers it is
/// ward_heckbert_1992.
Jet<Rgb> jarosz_2008b(const HemisphereGather& gather, WallDistance distance = WallDistance::refined);

}  // namespace isophote
