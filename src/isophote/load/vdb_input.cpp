#include "isophote/load/vdb_input.h"

#include <bit>
#include <cstring>
#include <string_view>

#include "isophote/core/error.h"

namespace isophote {

VdbInput::VdbInput(const std::string& path) : std::istream(nullptr) {
  rdbuf(&buffer_);
  exceptions(std::ios::eofbit | std::ios::failbit | std::ios::badbit);
  if (!buffer_.open(path, std::ios::in | std::ios::binary)) setstate(std::ios::failbit);
  end_ = seekg(0, std::ios::end).tellg();
  seekg(0);
}

std::uint32_t VdbInput::read_word() {
  std::uint32_t word = 0;
  read(reinterpret_cast<char*>(&word), sizeof word);
  return word;
}

std::string VdbInput::read_text() {
  const std::uint32_t length = read_word();
  if (length > end_ - tellg()) throw UserError("is damaged: a text or value in it is longer than what is left");
  std::string text(length, '\0');
  read(text.data(), length);
  return text;
}

// OpenVDB reads a node's value mask; a byte that says which values follow; the size of these in bytes, below 0 where
// they are not compressed; and then all of them at once, into a buffer for as many as the mask has. Whether they fit,
// it checks too late, and Blosc is not told how long its chunk is: that stands in the last 4 of the 16 bytes with which
// it begins.
void VdbInput::Buffer::note(const char* bytes, std::streamsize count) {
  constexpr char all_values = 6;
  const bool is_mask = count == 8 * 8 || count == 8 * 64 || count == 8 * 512;  // of a leaf, and of the nodes above it
  if (is_mask) {
    mask_bits_ = 8 * count, mask_on_ = 0;
    for (std::streamsize i = 0; i < count; ++i) mask_on_ += std::popcount(static_cast<unsigned char>(bytes[i]));
  }
  if (count == 1) values_ = nodes.active_only && *bytes != all_values ? mask_on_ : mask_bits_;
  announced_ = 0;
  if (count == sizeof announced_) std::memcpy(&announced_, bytes, sizeof announced_);
}

void VdbInput::Buffer::check_chunk(std::streamsize count) const {
  if (-announced_ == count && count != values_ * nodes.per_value)
    throw UserError("is damaged: a node has another number of values than it says");
}

// Metadata for delayed loading are of no use here, and hold more that is believed: under another type's name OpenVDB
// takes them for bytes.
std::streamsize VdbInput::Buffer::xsgetn(char* to, std::streamsize count) {
  constexpr std::string_view delayed_loading = "__delayedload";
  constexpr std::streamsize header = 16;
  const bool in_nodes =
      announced_ != 0 && (nodes.by_blosc || nodes.by_zip) && seekoff(0, std::ios::cur, std::ios::in) >= nodes.begin;
  if (in_nodes) check_chunk(count);
  const bool by_blosc = in_nodes && nodes.by_blosc && announced_ == count;
  const std::streamsize got = std::filebuf::xsgetn(to, count);
  if (got != count) return got;
  if (by_blosc) {
    std::uint32_t own = 0;
    if (count >= header) std::memcpy(&own, to + header - sizeof own, sizeof own);
    if (own != count) throw UserError("is damaged: a compressed chunk has another size than it says");
  }
  if (std::string_view(to, static_cast<std::size_t>(got)) == delayed_loading) to[0] = '-';
  note(to, count);
  return got;
}

}  // namespace isophote
