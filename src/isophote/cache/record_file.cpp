#include "isophote/cache/record_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <system_error>

#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/core/hash.h"
#include "isophote/core/ray.h"

namespace isophote {
namespace {

constexpr char magic[8] = {'I', 'S', 'O', 'P', 'H', 'R', 'E', 'C'};
constexpr std::uint32_t version = 5;

/// Puts numbers into bytes, least significant first.
struct Packer {
  std::string bytes;

  void integer(std::uint64_t v, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(v >> (8 * i)));
  }
  void operator()(float& v) { integer(std::bit_cast<std::uint32_t>(v), 4); }
  void operator()(std::uint32_t& v) { integer(v, 4); }
  void operator()(std::uint16_t& v) { integer(v, 2); }
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
  void operator()(std::uint32_t& v) { v = static_cast<std::uint32_t>(integer(4)); }
  void operator()(std::uint16_t& v) { v = static_cast<std::uint16_t>(integer(2)); }
  void operator()(std::uint8_t& v) { v = static_cast<std::uint8_t>(integer(1)); }
};

/// The one place that says what of a record is on file, and in which order.
template <class Stream>
void transfer(Stream& io, Record& r) {
  const auto vec = [&](Vec3& v) { io(v.x), io(v.y), io(v.z); };
  const auto rgb = [&](Rgb& c) { io(c.r), io(c.g), io(c.b); };
  const auto gradient = [&](Gradient<Rgb>& g) { rgb(g.x), rgb(g.y), rgb(g.z); };
  const auto form = [&](Sym3& m) { io(m.xx), io(m.xy), io(m.xz), io(m.yy), io(m.yz), io(m.zz); };
  Footprint& f = r.footprint;
  auto falloff = static_cast<std::uint8_t>(f.falloff);
  vec(r.position), vec(r.normal);
  form(f.shape);
  io(f.normal_scale), io(f.radius), io(f.unscaled), io(f.smallest), io(f.largest);
  io(falloff), io(f.order);
  f.falloff = static_cast<Falloff>(falloff);
  io(r.gradient_scale), io(r.curvature_scale);
  rgb(r.jet.value), gradient(r.jet.translational), gradient(r.jet.rotational);
  form(r.jet.hessian);
  io(r.jet.standard_error), io(r.jet.gradient_error), io(r.jet.rays);
  io(r.jet.distances.harmonic_mean);
  Obstacles& obstacles = r.jet.distances.obstacles;
  for (std::uint16_t& sector : obstacles.nearest) io(sector);
  obstacles.least = *std::min_element(obstacles.nearest.begin(), obstacles.nearest.end());
}

/// What the footprints were decided by.
template <class Stream>
void transfer(Stream& io, Pilot& pilot, float& threshold) {
  auto known = static_cast<std::uint8_t>(pilot.known);
  io(known), io(pilot.error_rate), io(pilot.irradiance), io(pilot.noise_rate), io(threshold);
  pilot.known = known != 0;
}
constexpr std::size_t pilot_size = 17;

std::size_t record_size() {
  Packer packer;
  Record record;
  transfer(packer, record);
  return packer.bytes.size();
}

/// Of bytes that come piece by piece.
struct Checksum {
  std::uint64_t sum = 0, count = 0;

  void add(std::string_view bytes) {
    for (const char byte : bytes) sum = mix_bits(sum ^ static_cast<unsigned char>(byte)) + count++;
  }
};

bool within(float v, float low, float high) { return low <= v && v <= high; }  // false for NaN

/// No semi-axis is longer than the radius: `shape` less the sphere of that radius, and a little for rounding, is
/// positive definite. It may be much flatter. Lookup finds records by their radius, and takes a root of the form.
bool shaped(const Footprint& f) {
  if (!(f.radius > 0 && f.radius <= std::numeric_limits<float>::max())) return false;
  constexpr double rounding = 1e-3;
  const double reach = f.radius * (1 + rounding), sphere = 1 / (reach * reach);
  const double xx = f.shape.xx - sphere, yy = f.shape.yy - sphere, zz = f.shape.zz - sphere;
  const double xy = f.shape.xy, xz = f.shape.xz, yz = f.shape.yz;
  const double minor = xx * yy - xy * xy;
  const double determinant = zz * minor - xx * yz * yz - yy * xz * xz + 2 * xy * xz * yz;
  return xx > 0 && minor > 0 && determinant > 0 && std::isfinite(determinant);
}

/// Irradiance that interpolation can add up: bounded wherever the record serves, and nowhere negative at its place.
bool bounded(const Jet<Rgb>& jet, float radius) {
  constexpr float most = 1e30f;
  for (int c = 0; c < 3; ++c) {
    const auto size = [c](const Gradient<Rgb>& g) {
      return std::hypot(double{g.x[c]}, double{g.y[c]}, double{g.z[c]});
    };
    const bool fits =
        within(jet.value[c], 0, most) && size(jet.translational) * radius <= most && size(jet.rotational) <= most;
    if (!fits) return false;
  }
  const Obstacles& obstacles = jet.distances.obstacles;
  for (int i = 0; i < Obstacles::sectors; ++i)
    if (!within(obstacles.distance(i), 0, infinity)) return false;
  return within(jet.distances.harmonic_mean, 0, infinity) && within(jet.gradient_error, 0, infinity);
}

/// The second-order term too is bounded wherever the record serves.
bool curved(const Record& r) {
  const Sym3& h = r.jet.hessian;
  double size = 0;
  for (const float entry : {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}) size += std::abs(double{entry});
  return within(r.curvature_scale, 0, 1e30f) &&
         size * r.curvature_scale * r.footprint.radius * r.footprint.radius * max_component(r.jet.value) <= 1e30;
}

/// A file that passes the checksum may still have been made by hand.
bool usable(const Record& r) {
  const Footprint& f = r.footprint;
  constexpr float most = std::numeric_limits<float>::max();
  const bool placed = is_finite(r.position) && std::abs(length(r.normal) - 1) < 1e-3f;
  const bool sized = within(f.normal_scale, 0, most) && within(f.unscaled, 0, most) &&
                     within(f.smallest, 0, f.radius) && f.largest >= f.radius;
  return placed && shaped(f) && sized && static_cast<int>(f.falloff) <= static_cast<int>(Falloff::tabellion) &&
         f.order <= 2 && within(r.jet.standard_error, 0, most) && within(r.gradient_scale, 0, 1) &&
         bounded(r.jet, f.radius) && curved(r);
}

bool usable(const Pilot& p) {
  constexpr float most = std::numeric_limits<float>::max();
  return within(p.error_rate, 0, most) && within(p.irradiance, 0, most) && within(p.noise_rate, 0, most);
}

constexpr std::size_t head_size = sizeof magic + 4 + 8 + 4;

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
    if (!(file.threshold > 0 && within(file.threshold, 0, 1))) fail("its threshold is malformed");
    const std::string count_bytes = take(8);
    const std::uint64_t count = Unpacker{count_bytes.data()}.integer(8), each = record_size();
    const std::uint64_t left = size_ - head_size - settings_size - pilot_size - 16;
    if (count != left / each || left % each != 0) fail("is cut off or malformed (its count of records is wrong)");
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::string bytes = take(each);
      Unpacker unpacker{bytes.data()};
      transfer(unpacker, file.records.emplace_back());
      if (!usable(file.records.back())) fail("record " + std::to_string(i) + " is malformed");
    }
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

  /// Up to the settings, whose size it returns.
  std::uint64_t read_head(RecordFile& file) {
    if (size_ < sizeof magic || take(sizeof magic) != std::string_view(magic, sizeof magic))
      fail("is not a record file");
    if (size_ < head_size + pilot_size + 16) fail("is cut off");
    const std::string rest = take(head_size - sizeof magic);
    Unpacker in{rest.data()};
    if (const auto found = in.integer(4); found != version)
      fail("has version " + std::to_string(found) + ", this program reads " + std::to_string(version));
    file.scene = in.integer(8);
    const std::uint64_t settings_size = in.integer(4);
    constexpr std::uint64_t largest = 1 << 20;  // settings are a page
    if (settings_size > largest || settings_size > size_ - head_size - pilot_size - 16)
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
