#pragma once

#include "load/gltf_builder.h"
#include "load/pictures.h"

namespace isophote::testing {

/// A triangle with both texture coordinates, its material, and one image that textures 0 and 1 show.
struct MaterialBuilder : GltfBuilder {
  MaterialBuilder() {
    json& primitive = triangle();
    for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"})
      primitive["attributes"][set] = accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", float_type, 2);
    primitive["material"] = 0;
    document["materials"] = {{{"name", "paint"}}};
    document["images"] = {{{"name", "picture"}, {"uri", png_uri(two_pixels())}}};
    document["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
    document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  }
  json& material() { return document["materials"][0]; }
  json& extension(const char* name) { return material()["extensions"][name]; }
};

}  // namespace isophote::testing
