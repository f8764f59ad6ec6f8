#include <functional>
#include <limits>

#include "load/sound_document.h"

namespace isophote::testing {
namespace {

struct Case {
  std::string name;
  std::function<void(GltfBuilder&)> damage;
  std::string message;  ///< after "test.gltf: "
};

void set_float(GltfBuilder& b, std::size_t index, float value) { std::memcpy(b.binary.data() + 4 * index, &value, 4); }
const float nan = std::numeric_limits<float>::quiet_NaN();
const std::string primitive_place = "meshes[0] \"mesh\": primitives[0]: ";

std::vector<Case> cases() {
  return {
      {"NoVersion", [](auto& b) { b.document["asset"].erase("version"); }, "asset.version: is missing"},
      {"OldVersion", [](auto& b) { b.document["asset"]["version"] = "1.0"; },
       "asset: version 1.0 is not supported, only glTF 2.0"},
      {"RequiredExtension",
       [](auto& b) {
         b.document["extensionsRequired"] = {"KHR_materials_ior", "KHR_draco_mesh_compression"};
       },
       "requires the extension KHR_draco_mesh_compression, which is not supported"},
      {"WrongType", [](auto& b) { b.document["nodes"][0]["mesh"] = "0"; },
       "nodes[0].mesh: must be a non-negative integer"},
      {"NotAnObject", [](auto& b) { b.document["materials"][0] = 3; }, "materials[0]: must be an object"},
      {"NotAnArray", [](auto& b) { b.document["nodes"] = json::object(); },
       "scenes[0].nodes: 0 is out of range: there are 0 nodes"},
      {"HugeNumber",
       [](auto& b) {
         b.document["nodes"][0]["scale"] = {1e39, 1, 1};
       },
       "nodes[0].scale: does not fit a 32-bit float"},
      {"ShortMatrix",
       [](auto& b) {
         b.document["nodes"][0]["matrix"] = {1, 0};
       },
       "nodes[0].matrix: must have 16 numbers"},
      {"ProjectiveMatrix",
       [](auto& b) { b.document["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
       "nodes[0]: matrix: is not affine: its last row is not 0 0 0 1"},
      {"ZeroRotation",
       [](auto& b) {
         b.document["nodes"][0]["rotation"] = {0, 0, 0, 0};
       },
       "nodes[0]: rotation: is not a quaternion that can be normalised"},
      {"MeshOutOfRange", [](auto& b) { b.document["nodes"][0]["mesh"] = 7; },
       "nodes[0].mesh: 7 is out of range: there are 1 meshes"},
      {"LightOutOfRange", [](auto& b) { b.document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1; },
       "nodes[1].extensions.KHR_lights_punctual.light: 1 is out of range: there are 1 lights"},
      {"SceneOutOfRange", [](auto& b) { b.document["scene"] = 1; }, "scene: 1 is out of range: there are 1 scenes"},
      {"TwoParents",
       [](auto& b) {
         b.document["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
       },
       "nodes[2]: has two parents"},
      {"Cycle",
       [](auto& b) {
         b.document["nodes"] = {json::object(), json::object(), {{"children", {3}}}, {{"children", {2}}}};
       },
       "nodes[3]: is its own ancestor"},
      {"RootWithParent", [](auto& b) { b.document["nodes"][0]["children"] = {1}; },
       "nodes[1] \"holder\": is a root of the scene and has a parent"},
      {"RootTwice",
       [](auto& b) {
         b.document["scenes"][0]["nodes"] = {1, 0, 1};
       },
       "nodes[1] \"holder\": is twice a root of the scene"},
      {"DeepNesting",
       [](auto& b) {
         json nodes = json::array();
         for (int i = 1; i <= 1100; ++i) nodes.push_back({{"children", {i}}});
         nodes.push_back({{"mesh", 0}});
         b.document["nodes"] = nodes, b.document["scenes"][0]["nodes"] = {0};
       },
       "nodes[1001]: is nested deeper than 1000 levels"},
      {"NoTriangles", [](auto& b) { b.document["scenes"][0]["nodes"] = {1}; }, "the scene has no triangles"},
      {"IndexOutOfRange", [](auto& b) { b.document["accessors"][0]["count"] = 2; },
       primitive_place + "index 2 is out of range: there are 2 vertices"},
      {"TooFewNormals", [](auto& b) { b.document["accessors"][1]["count"] = 2; },
       primitive_place + "NORMAL: has 2 elements, but vertex 2 is used"},
      {"NanPosition", [](auto& b) { set_float(b, 3, nan); },
       primitive_place + "POSITION: vertex 1 is not a number, or farther than 1e+09 from the origin"},
      {"InfinitePosition", [](auto& b) { set_float(b, 4, HUGE_VALF); },
       primitive_place + "POSITION: vertex 1 is not a number, or farther than 1e+09 from the origin"},
      {"OverflowingTransform",
       [](auto& b) {
         b.document["nodes"][0]["scale"] = {1e38, 1, 1};
       },
       primitive_place + "POSITION: vertex 1 is not a number, or farther than 1e+09 from the origin"},
      {"NanTexCoord", [](auto& b) { set_float(b, 18, nan); },
       primitive_place + "TEXCOORD_0: vertex 0 is not a number, or over 1e+06"},
      {"NanColor", [](auto& b) { set_float(b, 24, nan); }, primitive_place + "COLOR_0: vertex 0 is not a number"},
      {"PositionType", [](auto& b) { b.document["accessors"][0]["type"] = "VEC2"; },
       primitive_place + "POSITION: has the wrong type"},
      {"PositionComponent", [](auto& b) { b.document["accessors"][0]["componentType"] = ushort_type; },
       primitive_place + "POSITION: has the wrong component type"},
      {"FloatIndices", [](auto& b) { b.document["meshes"][0]["primitives"][0]["indices"] = 0; },
       primitive_place + "accessors[0]: indices must be unsigned integers"},
      {"DoubleComponents", [](auto& b) { b.document["accessors"][0]["componentType"] = 5130; },
       primitive_place + "POSITION: accessors[0]: component type 5130 is not one of glTF 2.0"},
      {"AccessorOverrun", [](auto& b) { b.document["accessors"][0]["count"] = 4; },
       primitive_place + "POSITION: accessors[0]: reaches beyond the 36 bytes of bufferViews[0]"},
      {"AccessorOffset", [](auto& b) { b.document["accessors"][0]["byteOffset"] = 9223372036854775807ull; },
       primitive_place + "POSITION: accessors[0]: reaches beyond the 36 bytes of bufferViews[0]"},
      {"NegativeOffset", [](auto& b) { b.document["accessors"][0]["byteOffset"] = -4; },
       "accessors[0].byteOffset: must be a non-negative integer"},
      {"ZeroCount", [](auto& b) { b.document["accessors"][0]["count"] = 0; },
       primitive_place + "POSITION: accessors[0]: count must be between 1 and 2^32 - 1"},
      {"SmallStride", [](auto& b) { b.document["bufferViews"][0]["byteStride"] = 8; },
       primitive_place + "POSITION: accessors[0]: byteStride is less than an element"},
      {"ViewOverrun", [](auto& b) { b.document["bufferViews"][1]["byteLength"] = 1000; },
       "bufferViews[1]: reaches beyond the 138 bytes of its buffer"},
      {"ViewOffset", [](auto& b) { b.document["bufferViews"][1]["byteOffset"] = 9223372036854775807ull; },
       "bufferViews[1]: reaches beyond the 138 bytes of its buffer"},
      {"ShortBuffer",
       [](auto& b) {
         b.document["buffers"] = {
             {{"byteLength", 1ull << 40}, {"uri", "data:application/octet-stream;base64," + base64(b.binary)}}};
       },
       "buffers[0]: byteLength is 1099511627776, but there are only 138 bytes"},
      {"MissingBuffer",
       [](auto& b) {
         b.document["buffers"] = {{{"byteLength", 4}, {"uri", "gone.bin"}}};
       },
       "buffers[0]: 'gone.bin': no such file"},
      {"NoBufferData",
       [](auto& b) {
         b.document["buffers"] = {{{"byteLength", 4}}};
       },
       "buffers[0]: has neither a uri nor the file's binary chunk"},
      {"AbsolutePath",
       [](auto& b) {
         b.document["buffers"] = {{{"byteLength", 4}, {"uri", "/etc/hostname"}}};
       },
       "buffers[0]: '/etc/hostname': lies outside the glTF file's folder"},
      {"EscapingPath",
       [](auto& b) {
         b.document["buffers"] = {{{"byteLength", 4}, {"uri", "a/%2e%2e/../b.bin"}}};
       },
       "buffers[0]: 'a/%2e%2e/../b.bin': lies outside the glTF file's folder"},
      {"OtherScheme",
       [](auto& b) {
         b.document["buffers"] = {{{"byteLength", 4}, {"uri", "https://a.b/c.bin"}}};
       },
       "buffers[0]: 'https://a.b/c.bin': only data URIs and relative paths are supported"},
      {"SparseOrder",
       [](auto& b) {
         const auto indices = b.view(std::vector<std::uint16_t>{2, 1}), values = b.view(std::vector<float>(6, 0.0f));
         b.document["accessors"][0]["sparse"] = {{"count", 2},
                                                 {"indices", {{"bufferView", indices}, {"componentType", ushort_type}}},
                                                 {"values", {{"bufferView", values}}}};
       },
       primitive_place + "POSITION: accessors[0]: sparse.indices must increase and stay below count"},
      {"SparseOverrun",
       [](auto& b) {
         const auto indices = b.view(std::vector<std::uint16_t>{1, 2}), values = b.view(std::vector<float>(3, 0.0f));
         b.document["accessors"][0]["sparse"] = {{"count", 2},
                                                 {"indices", {{"bufferView", indices}, {"componentType", ushort_type}}},
                                                 {"values", {{"bufferView", values}}}};
       },
       primitive_place + "POSITION: accessors[0]: reaches beyond the 12 bytes of bufferViews[6]"},
      {"AlphaMode", [](auto& b) { b.document["materials"][0]["alphaMode"] = "GLOW"; },
       "materials[0] \"wood\": alphaMode 'GLOW' is not one of glTF 2.0"},
      {"NegativeEmission",
       [](auto& b) {
         b.document["materials"][0]["emissiveFactor"] = {0, -1, 0};
       },
       "materials[0] \"wood\": emissiveFactor times emissiveStrength must be a number between 0 and 1e+30"},
      {"OverflowingEmission",
       [](auto& b) {
         b.document["materials"][0]["emissiveFactor"] = {1e20, 1, 1};
         b.document["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1e20;
       },
       "materials[0] \"wood\": emissiveFactor times emissiveStrength must be a number between 0 and 1e+30"},
      {"SmallIor", [](auto& b) { b.document["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 0.5; },
       "materials[0] \"wood\": ior 0.5 is neither 0 nor between 1 and 1000"},
      {"ThirdTexCoord",
       [](auto& b) { b.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2; },
       "materials[0] \"wood\": baseColorTexture: texCoord 2: only 0 and 1 are supported"},
      {"MissingTexture",
       [](auto& b) {
         b.document["images"][0] = {{"name", "oak"}, {"uri", "oak.png"}};
       },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": 'oak.png': no such file"},
      {"NotAPicture",
       [](auto& b) { b.document["images"][0]["uri"] = png_uri(to_bytes("GIF89a, and no more than that")); },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: is neither a PNG nor a "
       "JPEG"},
      {"TruncatedPicture",
       [](auto& b) {
         Bytes bytes = two_pixels();
         bytes.resize(50);
         b.document["images"][0]["uri"] = png_uri(bytes);
       },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: is broken: it cannot be "
       "decoded"},
      {"AbsurdPicture", [](auto& b) { b.document["images"][0]["uri"] = png_uri(png(60000, 60000, {})); },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: is 60000x60000, more than "
       "the 134217728 pixels allowed"},
      {"AbsurdJpeg",
       [](auto& b) {
         b.document["images"][0]["uri"] =
             png_uri({0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xc0, 0, 11, 8, 0xff, 0xff, 0xff, 0xff, 1, 1, 0x11, 0});
       },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: is 65535x65535, more than "
       "the 134217728 pixels allowed"},
      {"EmptyPicture", [](auto& b) { b.document["images"][0]["uri"] = png_uri(png(16384, 8192, {})); },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: is broken: its header "
       "claims "
       "more than the file can hold"},
      {"PictureBeyondMemory", [](auto& b) { b.document["images"][0]["uri"] = png_uri(png(1 << 27, 1, {}, 4, 16)); },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: image: does not fit in "
       "memory: needs 2560."},
      {"JpegBeyondMemory",
       [](auto& b) {
         b.document["images"][0]["uri"] =
             png_uri({0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xc0, 0, 11, 8, 0x20, 0, 0x40, 0, 1, 1, 0x11, 0});
       },
       "materials[0] \"wood\": baseColorTexture: textures[0]: images[0] \"oak\": data URI: image: does not fit in "
       "memory: needs 2048.0 MiB, "},
      {"NoImage", [](auto& b) { b.document["textures"][0].erase("source"); },
       "materials[0] \"wood\": baseColorTexture: textures[0]: has no PNG or JPEG source"},
      {"WrapMode", [](auto& b) { b.document["samplers"][0]["wrapS"] = 1; },
       "materials[0] \"wood\": baseColorTexture: textures[0]: wrap mode 1 is not one of glTF 2.0"},
      {"Orthographic",
       [](auto& b) {
         b.document["cameras"][0] = {{"name", "plan"},
                                     {"type", "orthographic"},
                                     {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}}}};
       },
       "cameras[0] \"plan\": orthographic cameras are not supported, only perspective ones"},
      {"FieldOfView", [](auto& b) { b.document["cameras"][0]["perspective"]["yfov"] = 4; },
       "cameras[0] \"eye\": perspective.yfov must lie between 0 and pi"},
      {"FlatCamera",
       [](auto& b) {
         b.document["nodes"][1]["scale"] = {1, 1, 0};
       },
       "cameras[0] \"eye\": its node's transform does not leave it a direction"},
      {"Cones",
       [](auto& b) { b.document["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["innerConeAngle"] = 1; },
       "lights[0] \"lamp\": spot: 0 <= innerConeAngle <= outerConeAngle <= pi/2 and outerConeAngle > 0 must hold"},
      {"NoCone",
       [](auto& b) { b.document["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["outerConeAngle"] = 0; },
       "lights[0] \"lamp\": spot: 0 <= innerConeAngle <= outerConeAngle <= pi/2 and outerConeAngle > 0 must hold"},
      {"LightType", [](auto& b) { b.document["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "area"; },
       "lights[0] \"lamp\": type 'area' is not point, spot or directional"},
      {"NegativeLight", [](auto& b) { b.document["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = -1; },
       "lights[0] \"lamp\": color times intensity must be a number between 0 and 1e+30"},
      {"BlindingLight",
       [](auto& b) { b.document["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 2e30; },
       "lights[0] \"lamp\": color times intensity must be a number between 0 and 1e+30"},
      {"NewlineInName",
       [](auto& b) {
         b.document["materials"][0] = {{"name", "a\nb"}, {"alphaMode", "x"}};
       },
       "materials[0] \"a?b\": alphaMode 'x' is not one of glTF 2.0"},
      {"DeepJson",
       [](auto& b) {
         json deep = 1;
         for (int i = 0; i < 200; ++i) deep = json::array({deep});
         b.document["extras"] = deep;
       },
       "the JSON is nested deeper than 128 levels"},
  };
}

class BadGltf : public ::testing::TestWithParam<Case> {};

TEST_P(BadGltf, IsRefusedInOneLine) {
  GltfBuilder builder = sound();
  GetParam().damage(builder);
  const std::string error = try_load(builder).error;
  EXPECT_EQ(error.substr(0, 11 + GetParam().message.size()), "test.gltf: " + GetParam().message);
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Cases, BadGltf, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace isophote::testing
