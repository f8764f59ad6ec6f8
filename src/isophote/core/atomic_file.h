#pragma once

#include <fstream>
#include <string>

namespace isophote {

/// A file that has its final name only once it is complete. It is written under a temporary name in the same folder and
/// renamed by `commit`; without that (an error, an exception) the temporary is removed and an older file of the final
/// name is left as it was.
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
  std::string path_, temporary_;
  std::ofstream stream_;
};

}  // namespace isophote
