#include "isophote/load/gltf_textures.h"

#include "isophote/load/gltf_images.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

Wrap wrap_mode(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      throw UserError("wrap mode " + std::to_string(mode) + " is not one of glTF 2.0");
  }
}

}  // namespace

int TextureTable::id(int index, bool srgb) {
  const auto i = static_cast<std::size_t>(index);
  const tinygltf::Texture& source = file_.model.textures[i];
  return with_place(place_name("textures", i, source.name), [&] {
    if (source.source < 0) throw UserError("has no PNG or JPEG source");
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    if (source.sampler >= 0) {
      const tinygltf::Sampler& sampler = file_.model.samplers[static_cast<std::size_t>(source.sampler)];
      wrap_u = wrap_mode(sampler.wrapS), wrap_v = wrap_mode(sampler.wrapT);
    }
    const Key key{source.source, wrap_u, wrap_v, srgb};
    if (const auto found = ids_.find(key); found != ids_.end()) return found->second;
    DecodedImage image = decode_image(file_, source.source, budget_);
    const std::string& image_name = file_.images[static_cast<std::size_t>(source.source)].name;
    textures_.push_back({source.name.empty() ? image_name : source.name, image.width, image.height,
                         std::move(image.rgba), srgb, wrap_u, wrap_v});
    return ids_[key] = static_cast<int>(textures_.size()) - 1;
  });
}

}  // namespace isophote
