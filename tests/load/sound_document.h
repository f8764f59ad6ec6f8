#pragma once

#include "load/gltf_builder.h"
#include "load/pictures.h"

namespace isophote::testing {

/// A sound document that uses nearly everything; each case breaks one thing.
inline GltfBuilder sound() {
  GltfBuilder b;
  json& primitive = b.triangle();
  primitive["attributes"]["NORMAL"] = b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  primitive["attributes"]["TEXCOORD_0"] = b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", float_type, 2);
  primitive["attributes"]["COLOR_0"] = b.vec3({1, 1, 1, 1, 1, 1, 1, 1, 1});
  primitive["indices"] = b.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", ushort_type, 1);
  primitive["material"] = 0;
  b.document["materials"] = {{{"name", "wood"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  b.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  b.document["samplers"] = {json::object()};
  b.document["images"] = {{{"name", "oak"}, {"uri", png_uri(two_pixels())}}};
  b.document["cameras"] = {{{"name", "eye"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"name", "lamp"}, {"type", "spot"}, {"spot", json::object()}}};
  b.node({{"name", "holder"}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return b;
}

}  // namespace isophote::testing
