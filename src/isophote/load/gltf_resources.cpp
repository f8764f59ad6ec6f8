#include "isophote/load/gltf_resources.h"

#include <tiny_gltf.h>

#include <cctype>

#include "isophote/load/messages.h"
#include "isophote/load/read_file.h"

namespace isophote {
namespace {

std::string percent_decode(const std::string& uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                        std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    if (escape) {
      decoded += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

bool has_scheme(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  return colon != uri.npos && uri.find('/') > colon;
}

std::filesystem::path inside(const std::string& uri, const std::filesystem::path& folder) {
  if (has_scheme(uri)) throw UserError("only data URIs and relative paths are supported");
  const std::string decoded = percent_decode(uri);
  if (decoded.empty() || decoded.find('\0') != decoded.npos) throw UserError("is not a path");
  const std::filesystem::path relative = std::filesystem::path(decoded).lexically_normal();
  if (relative.is_absolute() || *relative.begin() == "..") throw UserError("lies outside the glTF file's folder");
  return folder / relative;
}

std::vector<unsigned char> decode_data_uri(const std::string& uri, MemoryBudget& budget) {
  if (!tinygltf::IsDataURI(uri)) throw UserError("data URI of an unknown media type, or not base64");
  budget.take(3 * uri.size(), "data URI");  // the decoder's copies
  std::vector<unsigned char> bytes;
  std::string media_type;
  if (!tinygltf::DecodeDataURI(&bytes, media_type, uri, 0, false)) throw UserError("data URI without data");
  return bytes;
}

}  // namespace

std::optional<std::filesystem::path> resource_file(const std::string& uri, const std::filesystem::path& folder) {
  if (uri.starts_with("data:")) return std::nullopt;
  return inside(uri, folder);
}

std::vector<unsigned char> read_resource(const std::string& uri, const std::filesystem::path& folder,
                                         MemoryBudget& budget) {
  const bool is_data = uri.starts_with("data:");
  return with_place("'" + (is_data ? uri.substr(0, 40) : uri) + "'",
                    [&] { return is_data ? decode_data_uri(uri, budget) : read_file(inside(uri, folder), budget); });
}

}  // namespace isophote
