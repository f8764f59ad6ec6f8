#pragma once

#include <optional>

#include "isophote/load/gltf_nodes.h"
#include "isophote/scene/scene.h"

namespace isophote {

/// The node's camera, if it has one. Throws UserError for an orthographic camera and for one without a proper field of
/// view or place.
std::optional<Camera> read_camera(const tinygltf::Model& model, const PlacedNode& placed);

/// The node's light (KHR_lights_punctual), if it has one: candela as W/sr, lux as W/m2, each channel for itself.
std::optional<PunctualLight> read_light(const tinygltf::Model& model, const PlacedNode& placed);

/// For scenes without a camera: all of `bounds`, seen from +Z, turned 30 degrees to the right and 20 degrees up, with a
/// vertical field of view of 40 degrees.
Camera default_view(const Box& bounds);

}  // namespace isophote
