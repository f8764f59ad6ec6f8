#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace isophote {

/// The file that writing to `path` replaces: symbolic links of the name itself are followed, also to a file that is not
/// there yet. What is still a link then is part of a ring of links.
std::filesystem::path link_target(std::filesystem::path path);

/// A file that has its final name only once it is complete. It is written under a temporary name in the same folder and
/// renamed by `commit`; without that (an error, an exception) the temporary is removed and an older file of the final
/// name is left as it was. Where that name is a symbolic link, the link stays and the file it leads to is replaced.
class AtomicFile {
 public:
  /// Opens the temporary for writing bytes. Throws UserError `PATH: reason` where that fails, or where `path` names
  /// something that is there and is not a regular file.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ofstream& stream() { return stream_; }

  /// Gives the file its name. Throws UserError where any write failed (a full disk), or where renaming does.
  void commit();

 private:
  std::string path_;  ///< as given, for messages
  std::filesystem::path target_, temporary_;
  std::ofstream stream_;
};

}  // namespace isophote
