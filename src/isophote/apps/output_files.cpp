#include "isophote/apps/output_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"

namespace isophote::app {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code failure;
  if (fs::equivalent(a, b, failure)) return true;  // both there, perhaps as hard links
  // A relative path of which nothing is there yet would stay relative.
  const auto whole = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(link_target(path), failure), failure);
  };
  const fs::path first = whole(a);
  return !first.empty() && first == whole(b);
}

}  // namespace

void require_png(const NamedFile& file) {
  if (!file.path.ends_with(".png")) throw UsageError(fmt::format("{}: the name must end in .png", file.name));
}

void check_distinct(std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_file(outputs[i].path, outputs[j].path))
        throw UsageError(fmt::format("{} and {} are one file", outputs[j].name, outputs[i].name));
}

void check_kept(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (const NamedFile& output : outputs)
    for (const NamedFile& input : inputs)
      if (same_file(output.path, input.path))
        throw UsageError(fmt::format("{} would overwrite {}", output.name, input.name));
}

}  // namespace isophote::app
