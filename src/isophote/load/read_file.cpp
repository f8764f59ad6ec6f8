#include "isophote/load/read_file.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "isophote/core/error.h"

namespace isophote {

std::vector<unsigned char> read_file(const std::filesystem::path& path, MemoryBudget& budget) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw UserError("no such file");
  if (error) throw UserError(error.message());
  if (fs::is_directory(status)) throw UserError("is a directory");
  if (!fs::is_regular_file(status)) throw UserError("is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw UserError(error.message());
  budget.take(size, "file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw UserError("cannot be opened");
  std::vector<unsigned char> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw UserError("cannot be read to its end");
  return bytes;
}

}  // namespace isophote
