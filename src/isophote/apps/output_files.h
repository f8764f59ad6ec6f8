#pragma once

#include <span>
#include <string>

namespace isophote::app {

/// A file of the command line, and what messages call it: "-o out.png", "the scene".
struct NamedFile {
  std::string name, path;
};

/// Throws UsageError where the path of `file` does not end in `.png`.
void require_png(const NamedFile& file);

/// Throws UsageError where two outputs are one file, or an output is a file that is read. Files are told apart by what
/// they are, there already or not, and not by their spelling: `.`, `..` and links are seen through.
void check_distinct(std::span<const NamedFile> outputs);
void check_kept(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

}  // namespace isophote::app
