#include "isophote/cache/record_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "isophote/cache/record_transfer.h"
#include "isophote/cache/usable_record.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/core/ray.h"

namespace isophote {
namespace {

constexpr char magic[8] = {'I', 'S', 'O', 'P', 'H', 'R', 'E', 'C'};
constexpr std::uint32_t version = 8;

using namespace record_transfer;

std::size_t record_size() {
  Packer packer;
  Record record;
  transfer(packer, record);
  return packer.bytes.size();
}

/// Of radiance, at surfaces or in media.
template <class R>
void pack(Packer& out, R& record) {
  auto bands = static_cast<std::uint8_t>(std::lround(std::sqrt(static_cast<float>(record.jet.value.size()))));
  bool has_gradient = !record.jet.translational.x.empty();
  transfer_head(out, record, bands, has_gradient);
  transfer_rest(out, record);
}
template <class R>
void pack_all(Packer& out, const std::vector<R>& records) {
  out.integer(records.size(), 8);
  for (R record : records) pack(out, record);
}
template <class R>
std::size_t packed_size(R record) {
  Packer packer;
  pack(packer, record);
  return packer.bytes.size();
}

/// How a message calls them.
constexpr const char* kind(const RadianceRecord&) { return "radiance"; }
constexpr const char* kind(const VolumeRecord&) { return "media"; }
constexpr int most_bands(const RadianceRecord&) { return most_order; }
constexpr int most_bands(const VolumeRecord&) { return most_volume_bands; }

/// Of bytes that come piece by piece.
struct Checksum {
  std::uint64_t sum = 0, count = 0;

  void add(std::string_view bytes) {
    for (const char byte : bytes) sum = mix_bits(sum ^ static_cast<unsigned char>(byte)) + count++;
  }
};

constexpr std::size_t head_size = sizeof magic + 4 + 8 + 4;

constexpr std::size_t checksum_size = 8, count_size = 8, basis_size = 1;

/// Takes a file apart from its start, so that what it claims is known to be true before it is kept: no more memory is
/// used than sound records fill.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (const auto status = fs::status(path, error); fs::exists(status) && !fs::is_regular_file(status))
      fail("is not a regular file");
    size_ = fs::file_size(path, error);
    in_.open(path, std::ios::binary);
    if (error || !in_) fail("cannot be opened");
  }

  RecordFile read() {
    RecordFile file;
    const std::uint64_t settings_size = read_head(file);
    file.settings = take(settings_size);
    const std::string pilot_bytes = take(pilot_size);
    Unpacker pilot_in{pilot_bytes.data()};
    transfer(pilot_in, file.pilot, file.threshold);
    if (static_cast<unsigned char>(pilot_bytes[0]) > 1 || !usable(file.pilot)) fail("its survey is malformed");
    if (!(file.threshold > 0 && file.threshold <= 1)) fail("its threshold is malformed");
    read_irradiance(file);
    take_in(basis_size, [&](Unpacker& in) {
      const std::uint64_t basis = in.integer(basis_size);
      if (basis > static_cast<std::uint64_t>(Basis::hemispherical)) fail("its basis is malformed");
      file.basis = static_cast<Basis>(basis);
    });
    read_radiance(file.radiance);
    for (std::vector<VolumeRecord>& each : file.volumes) read_radiance(each);
    if (left() != checksum_size) fail("is malformed (it is longer than its records)");
    const std::uint64_t sum = checksum_.sum;
    const std::string sum_bytes = take(8);
    if (Unpacker{sum_bytes.data()}.integer(8) != sum) fail("is harmed (its checksum does not agree)");
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw UserError(path_ + ": " + reason); }

  std::string take(std::uint64_t count) {
    std::string bytes(count, '\0');
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(count))) fail("cannot be read");
    checksum_.add(bytes);
    return bytes;
  }

  /// Bytes that are still to come.
  std::uint64_t left() const { return size_ - checksum_.count; }

  /// Was that well formed?
  template <class Transfer>
  bool take_in(std::uint64_t count, const Transfer& transfer) {
    if (count + checksum_size > left()) fail("is cut off or malformed (a record is)");
    const std::string bytes = take(count);
    Unpacker in{bytes.data()};
    transfer(in);
    return !in.malformed;
  }

  /// Of records that take `each` bytes at least.
  std::uint64_t take_count(std::uint64_t each) {
    std::uint64_t count = 0;
    take_in(count_size, [&](Unpacker& in) { count = in.integer(count_size); });
    if (count > left() / each) fail("is cut off or malformed (its count of records is wrong)");
    return count;
  }

  void read_irradiance(RecordFile& file) {
    const std::uint64_t each = record_size(), count = take_count(each);
    for (std::uint64_t i = 0; i < count; ++i) {
      Record& record = file.records.emplace_back();
      const bool formed = take_in(each, [&](Unpacker& in) { transfer(in, record); });
      if (!formed || !usable(record)) fail("record " + std::to_string(i) + " is malformed");
    }
  }

  template <class R>
  void read_radiance(std::vector<R>& records) {
    const std::uint64_t head = packed_size(R{}), count = take_count(head);
    for (std::uint64_t i = 0; i < count; ++i) {
      R& record = records.emplace_back();
      std::uint8_t bands = 0;
      bool has_gradient = false;
      const bool formed = take_in(head, [&](Unpacker& in) { transfer_head(in, record, bands, has_gradient); });
      const bool sized = formed && bands > 0 && bands <= most_bands(record);
      if (sized) {
        for (Coefficients* all : coefficients(record))
          if (has_gradient || all == &record.jet.value) all->resize(harmonics_count(bands));
        take_in(packed_size(record) - head, [&](Unpacker& in) { transfer_rest(in, record); });
      }
      if (!sized || !usable(record)) fail("record " + std::to_string(i) + " of " + kind(record) + " is malformed");
    }
  }

  /// Up to the settings, whose size it returns.
  std::uint64_t read_head(RecordFile& file) {
    if (size_ < sizeof magic || take(sizeof magic) != std::string_view(magic, sizeof magic))
      fail("is not a record file");
    constexpr std::size_t counts = 4 * count_size;  // of records of each kind, of which there may be none
    if (size_ < head_size + pilot_size + counts + basis_size + checksum_size) fail("is cut off");
    const std::string rest = take(head_size - sizeof magic);
    Unpacker in{rest.data()};
    if (const auto found = in.integer(4); found != version)
      fail("has version " + std::to_string(found) + ", this program reads " + std::to_string(version));
    file.scene = in.integer(8);
    const std::uint64_t settings_size = in.integer(4);
    constexpr std::uint64_t largest = 1 << 20;  // settings are a page
    if (settings_size > largest || settings_size > size_ - head_size - pilot_size - checksum_size)
      fail("is cut off or malformed (its settings are too long)");
    return settings_size;
  }

  std::string path_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
  Checksum checksum_;
};

}  // namespace

void write_records(const std::string& path, const RecordFile& file) {
  Packer out;
  out.bytes.append(magic, sizeof magic);
  out.integer(version, 4);
  out.integer(file.scene, 8);
  out.integer(file.settings.size(), 4);
  out.bytes += file.settings;
  Pilot pilot = file.pilot;
  float threshold = file.threshold;
  transfer(out, pilot, threshold);
  out.integer(file.records.size(), 8);
  for (Record record : file.records) transfer(out, record);
  out.integer(static_cast<std::uint64_t>(file.basis), 1);
  pack_all(out, file.radiance);
  for (const std::vector<VolumeRecord>& each : file.volumes) pack_all(out, each);
  Checksum checksum;
  checksum.add(out.bytes);
  out.integer(checksum.sum, 8);
  AtomicFile result(path);
  result.stream().write(out.bytes.data(), static_cast<std::streamsize>(out.bytes.size()));
  result.commit();
}

RecordFile read_records(const std::string& path) { return Reader(path).read(); }

void require_match(const std::string& path, const RecordFile& file, std::uint64_t scene, const std::string& settings) {
  if (file.scene != scene) throw UserError(path + ": its records were made for another scene");
  std::istringstream theirs(file.settings), ours(settings);
  std::string a, b;
  while (true) {
    const bool more_a = static_cast<bool>(std::getline(theirs, a)), more_b = static_cast<bool>(std::getline(ours, b));
    if (!more_a && !more_b) return;
    if (!more_a || !more_b || a != b)
      throw UserError(path + ": its records were made with other settings: " + (more_a ? a : "nothing") + " there, " +
                      (more_b ? b : "nothing") + " here");
  }
}

}  // namespace isophote
