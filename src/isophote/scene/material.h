#pragma once

#include <string>

#include "isophote/core/ray.h"
#include "isophote/core/rgb.h"
#include "isophote/scene/texture.h"

namespace isophote {

enum class Alpha : std::uint8_t { opaque, mask, blend };

/// A glTF metallic-roughness material with the extensions that are understood. Factors multiply textures.
struct Material {
  std::string name;
  Rgb base_color{1.0f};
  float base_alpha = 1;
  TextureUse base_color_texture;
  float metallic = 1, roughness = 1;
  TextureUse metallic_roughness_texture;  ///< green: roughness, blue: metallic
  TextureUse normal_texture;
  float normal_scale = 1;
  Rgb emission{0.0f};  ///< radiance, KHR_materials_emissive_strength multiplied in
  TextureUse emission_texture;
  bool double_sided = false;  ///< emits from both sides; every surface scatters on both sides
  Alpha alpha = Alpha::opaque;
  float alpha_cutoff = 0.5f;

  float specular = 1;  ///< KHR_materials_specular
  Rgb specular_color{1.0f};
  TextureUse specular_texture, specular_color_texture;  ///< alpha of the one, colour of the other
  float ior = 1.5f;                                     ///< KHR_materials_ior; 0: the Fresnel term is 1 at all angles
  float transmission = 0;                               ///< KHR_materials_transmission, smooth
  TextureUse transmission_texture;
  bool solid = false;           ///< KHR_materials_volume with thickness > 0: refracts; else a thin sheet
  Rgb attenuation_color{1.0f};  ///< colour left of white light after attenuation_distance inside
  float attenuation_distance = infinity;
};

}  // namespace isophote
