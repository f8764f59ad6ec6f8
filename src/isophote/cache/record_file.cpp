#include "isophote/cache/record_file.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/core/ray.h"

namespace isophote {
namespace {

constexpr char magic[8] = {'I', 'S', 'O', 'P', 'H', 'R', 'E', 'C'};
constexpr std::uint32_t version = 1;

/// Puts numbers into bytes, least significant first.
struct Packer {
  std::string bytes;

  void integer(std::uint64_t v, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(v >> (8 * i)));
  }
  void operator()(float& v) { integer(std::bit_cast<std::uint32_t>(v), 4); }
  void operator()(std::uint8_t& v) { integer(v, 1); }
};

/// And takes them out; the caller has made sure that there are enough.
struct Unpacker {
  const char* at;

  std::uint64_t integer(int size) {
    std::uint64_t v = 0;
    for (int i = 0; i < size; ++i) v |= static_cast<std::uint64_t>(static_cast<unsigned char>(*at++)) << (8 * i);
    return v;
  }
  void operator()(float& v) { v = std::bit_cast<float>(static_cast<std::uint32_t>(integer(4))); }
  void operator()(std::uint8_t& v) { v = static_cast<std::uint8_t>(integer(1)); }
};

/// The one place that says what of a record is on file, and in which order.
template <class Stream>
void transfer(Stream& io, Record& r) {
  const auto vec = [&](Vec3& v) { io(v.x), io(v.y), io(v.z); };
  const auto rgb = [&](Rgb& c) { io(c.r), io(c.g), io(c.b); };
  const auto gradient = [&](Gradient<Rgb>& g) { rgb(g.x), rgb(g.y), rgb(g.z); };
  Footprint& f = r.footprint;
  auto falloff = static_cast<std::uint8_t>(f.falloff);
  vec(r.position), vec(r.normal);
  io(f.shape.xx), io(f.shape.xy), io(f.shape.xz), io(f.shape.yy), io(f.shape.yz), io(f.shape.zz);
  io(f.normal_scale), io(f.radius), io(f.unscaled), io(f.smallest), io(f.largest);
  io(falloff), io(f.order);
  f.falloff = static_cast<Falloff>(falloff);
  io(r.gradient_scale), rgb(r.jet.value), gradient(r.jet.translational), gradient(r.jet.rotational);
  io(r.jet.distances.harmonic_mean);
}

std::size_t record_size() {
  Packer packer;
  Record record;
  transfer(packer, record);
  return packer.bytes.size();
}

std::uint64_t checksum(const char* bytes, std::size_t count) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum = mix_bits(sum ^ static_cast<unsigned char>(bytes[i])) + i;
  return sum;
}

/// A file that passes the checksum may still have been made by hand.
bool usable(const Record& r) {
  const Footprint& f = r.footprint;
  const auto finite = [](const Gradient<Rgb>& g) { return is_finite(g.x) && is_finite(g.y) && is_finite(g.z); };
  const auto within = [](float v, float low, float high) { return low <= v && v <= high; };  // false for NaN
  constexpr float most = std::numeric_limits<float>::max();
  const bool placed = is_finite(r.position) && std::abs(length(r.normal) - 1) < 1e-3f;
  // A positive diagonal and finite products: a shape that is not positive definite serves too much, never a NaN.
  const Vec3 diagonal{f.shape.xx, f.shape.yy, f.shape.zz}, others{f.shape.xy, f.shape.xz, f.shape.yz};
  const bool shaped = is_finite(diagonal) && is_finite(others) && f.shape.xx > 0 && f.shape.yy > 0 && f.shape.zz > 0;
  const bool bounded = f.radius > 0 && within(f.radius, 0, most) && within(f.normal_scale, 0, most) &&
                       within(f.unscaled, 0, most) && within(f.smallest, 0, f.radius) && f.largest >= f.radius;
  return placed && shaped && bounded && static_cast<int>(f.falloff) <= static_cast<int>(Falloff::tent) &&
         f.order <= 1 && within(r.gradient_scale, 0, 1) && within(r.jet.distances.harmonic_mean, 0, infinity) &&
         is_finite(r.jet.value) && finite(r.jet.translational) && finite(r.jet.rotational);
}

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw UserError(path + ": cannot be opened");
  std::string bytes;
  for (char piece[1 << 16]; in.read(piece, sizeof piece), in.gcount() > 0;)
    bytes.append(piece, static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw UserError(path + ": cannot be read");
  return bytes;
}

}  // namespace

void write_records(const std::string& path, const RecordFile& file) {
  Packer out;
  out.bytes.append(magic, sizeof magic);
  out.integer(version, 4);
  out.integer(file.scene, 8);
  out.integer(file.settings.size(), 4);
  out.bytes += file.settings;
  out.integer(file.records.size(), 8);
  for (Record record : file.records) transfer(out, record);
  out.integer(checksum(out.bytes.data(), out.bytes.size()), 8);
  AtomicFile result(path);
  result.stream().write(out.bytes.data(), static_cast<std::streamsize>(out.bytes.size()));
  result.commit();
}

RecordFile read_records(const std::string& path) {
  const std::string bytes = read_all(path);
  constexpr std::size_t head = sizeof magic + 4 + 8 + 4;
  if (bytes.size() < sizeof magic || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    throw UserError(path + ": is not a record file");
  if (bytes.size() < head + 16) throw UserError(path + ": is cut off");
  Unpacker in{bytes.data() + sizeof magic};
  if (const auto found = in.integer(4); found != version)
    throw UserError(path + ": has version " + std::to_string(found) + ", this program reads " +
                    std::to_string(version));
  if (Unpacker tail{bytes.data() + bytes.size() - 8}; tail.integer(8) != checksum(bytes.data(), bytes.size() - 8))
    throw UserError(path + ": is cut off or harmed (its checksum does not agree)");

  RecordFile file;
  file.scene = in.integer(8);
  const std::uint64_t text = in.integer(4);
  if (text > bytes.size() - head - 16) throw UserError(path + ": is malformed (settings longer than the file)");
  file.settings.assign(in.at, text);
  in.at += text;
  const std::uint64_t count = in.integer(8), left = bytes.size() - head - 16 - text, each = record_size();
  if (count != left / each || left % each != 0)
    throw UserError(path + ": is malformed (its count of records is wrong)");
  file.records.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    transfer(in, file.records[i]);
    if (!usable(file.records[i])) throw UserError(path + ": record " + std::to_string(i) + " is malformed");
  }
  return file;
}

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
