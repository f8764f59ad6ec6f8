#pragma once

#include "isophote/scene/scene.h"
#include "support/scenes.h"

namespace isophote {

inline Scene floor_of(const Material& material) {
  Scene scene;
  scene.meshes.push_back(scenes::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, scenes::add(scene, material)));
  return scene;
}

/// A horizontal square lamp of radiance 3 above the floor's middle, shining down.
inline Scene floor_with_lamp(const Material& material, float height, bool double_sided = false) {
  Scene scene = floor_of(material);
  Material lamp = scenes::emissive(Rgb(0.0f), Rgb(3.0f));
  lamp.double_sided = double_sided;
  scene.meshes.push_back(scenes::quad({-0.5f, height, -0.5f}, {1, 0, 0}, {0, 0, 1}, scenes::add(scene, lamp)));
  return scene;
}

/// Of both lobes, the glossy one as bright as a varnish never is.
inline Material shiny(float roughness) {
  Material material = scenes::diffuse({0.3f, 0.5f, 0.7f});
  material.specular = 1;
  material.ior = 2.5f;
  material.roughness = roughness;
  return material;
}

}  // namespace isophote
