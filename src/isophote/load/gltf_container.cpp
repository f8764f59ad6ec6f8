#include "isophote/load/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "isophote/core/error.h"

namespace isophote {
namespace {

constexpr std::uint32_t glb_magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr std::size_t glb_header = 12, chunk_header = 8;

std::uint32_t little_endian(std::span<const unsigned char> bytes, std::size_t at) {
  return bytes[at] | static_cast<std::uint32_t>(bytes[at + 1]) << 8 | static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

GltfContainer split_glb(std::span<const unsigned char> bytes) {
  if (bytes.size() < glb_header + chunk_header) throw UserError("truncated: a GLB header is longer than the file");
  if (const auto version = little_endian(bytes, 4); version != 2)
    throw UserError(fmt::format("GLB version {} is not supported, only 2", version));
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size())
    throw UserError(fmt::format("truncated: its header says {} bytes, the file has {}", length, bytes.size()));
  bytes = bytes.first(length);

  GltfContainer parts;
  std::size_t at = glb_header;
  for (int chunk = 0; at + chunk_header <= length; ++chunk) {
    const std::size_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    at += chunk_header;
    if (size > length - at) throw UserError(fmt::format("GLB chunk {} reaches beyond the end of the file", chunk));
    const auto data = bytes.subspan(at, size);
    if (chunk == 0 && type != json_chunk) throw UserError("the first GLB chunk is not JSON");
    if (chunk == 0) parts.json = {reinterpret_cast<const char*>(data.data()), data.size()};
    if (chunk == 1 && type == binary_chunk) parts.binary = data;
    at += size;
  }
  if (parts.json.empty()) throw UserError("truncated: the GLB has no JSON chunk");
  return parts;
}

struct JsonShape {
  std::size_t values = 1, depth = 0;
};

/// How many values and levels there are at most in a text, well-formed or not.
JsonShape measure(std::string_view text) {
  JsonShape shape;
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      shape.depth = std::max(shape.depth, ++depth);
      ++shape.values;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    } else if (c == ',') {
      ++shape.values;
    }
  }
  return shape;
}

}  // namespace

GltfContainer split_container(std::span<const unsigned char> bytes) {
  if (bytes.size() >= 4 && little_endian(bytes, 0) == glb_magic) return split_glb(bytes);
  return {{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
}

nlohmann::json parse_json(std::string_view text, MemoryBudget& budget) {
  constexpr std::size_t deepest = 128;
  constexpr std::uint64_t bytes_per_value = 128;  // a node of an object, its key and its value
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw UserError("the JSON text is over 2 GiB");
  const JsonShape shape = measure(text);
  if (shape.depth > deepest) throw UserError(fmt::format("the JSON is nested deeper than {} levels", deepest));
  budget.take(3 * text.size() + bytes_per_value * shape.values, "JSON");
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    const std::string_view what = error.what();  // "[json.exception.NAME] what happened"
    const std::size_t end = what.find("] ");
    throw UserError("not valid JSON: " + std::string(end == what.npos ? what : what.substr(end + 2)));
  }
}

}  // namespace isophote
