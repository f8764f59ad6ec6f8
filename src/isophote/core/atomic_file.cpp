#include "isophote/core/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <utility>

#include "isophote/core/error.h"

namespace isophote {
namespace {

std::filesystem::path temporary_name(std::filesystem::path path) {
  std::random_device random;
  return path += "." + std::to_string(random()) + ".tmp";
}

}  // namespace

std::filesystem::path link_target(std::filesystem::path path) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code failure;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(path, failure); ++i) {
    const auto target = std::filesystem::read_symlink(path, failure);
    if (failure) break;
    path = path.parent_path() / target;
  }
  return path;
}

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), target_(link_target(path_)), temporary_(temporary_name(target_)) {
  // Renaming onto /dev/null would replace the device.
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw UserError(path_ + ": cannot write: not a regular file");
  if (std::filesystem::is_symlink(target_, ignored)) throw UserError(path_ + ": cannot write: " + std::strerror(ELOOP));
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw UserError(path_ + ": cannot write: " + std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) throw UserError(path_ + ": cannot write: " + std::strerror(errno ? errno : EIO));
  std::error_code failure;
  std::filesystem::rename(temporary_, target_, failure);
  if (failure) throw UserError(path_ + ": cannot write: " + failure.message());
  temporary_.clear();
}

}  // namespace isophote
