// Reads any bytes as a record file, as they are and with a right checksum, and looks up in what was accepted.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "isophote/cache/radiance_cache.h"
#include "isophote/cache/radiance_regression.h"
#include "isophote/cache/record_file.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/core/error.h"
#include "support/sign_record_file.h"

namespace {

using namespace isophote;

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Interpolated irradiance is neither negative nor beyond numbers.
void look_up(const RecordCache& cache, const Record& record, const Vec3& offset) {
  const auto found =
      cache.interpolate({record.position + offset * record.footprint.radius, record.normal, record.normal});
  if (found && !(is_finite(*found) && std::min({found->r, found->g, found->b}) >= 0)) std::abort();
}

/// Nor is what a lobe reflects of radiance.
void reflect(const RadianceCache& cache, const RadianceRecord& record, const Vec3& offset) {
  const auto found =
      cache.reflect({record.position + offset * record.footprint.radius, record.normal, record.normal}, record.normal,
                    RadianceCache::bands(record), [](Lobe& lobe, float) { lobe.coefficients.fill(Rgb(0.5f)); });
  if (found && !(is_finite(*found) && std::min({found->r, found->g, found->b}) >= 0)) std::abort();
}

/// Nor is what media scatter towards any side.
void scatter(const VolumeCache& cache, const VolumeRecord& record, const Vec3& offset) {
  const int bands = VolumeCache::bands(record);
  for (const Vec3& wo : {Vec3{0, 0, 1}, Vec3{0.6f, -0.8f, 0}}) {
    const auto found = cache.scattered({record.position + offset * record.footprint.radius, record.media},
                                       phase_lobe(0.6f, wo, bands), bands);
    if (found && !(is_finite(*found) && std::min({found->r, found->g, found->b}) >= 0)) std::abort();
  }
}

/// As many as there were, each fitted to its neighbours.
RadianceCache fitted(const RadianceCache& cache) {
  const RadianceRegression regression(cache);
  RadianceCache result(cache.bounds(), cache.basis());
  for (std::uint32_t id = 0; id < cache.records().size(); ++id) result.insert(regression.fitted(id, {}));
  return result;
}

/// What was accepted can be indexed, fitted and looked up, and is written back as it was.
void use(const std::string& path, const std::string& bytes) {
  const RecordFile file = read_records(path);
  RecordCache cache({{0, 0, 0}, {1, 1, 1}});
  for (const Record& record : file.records) cache.insert(record);
  for (const Record& record : file.records)
    for (const Vec3& offset : {Vec3{}, Vec3{0.5f, 0, 0}, Vec3{0, 0.5f, 0}, Vec3{0, 0, 0.5f}})
      look_up(cache, record, offset);
  RadianceCache radiance(cache.bounds(), file.basis);
  for (const RadianceRecord& record : file.radiance) radiance.insert(record);
  for (const RadianceCache& each : {radiance, fitted(radiance)})
    for (const RadianceRecord& record : each.records())
      for (const Vec3& offset : {Vec3{}, Vec3{0.5f, 0, 0}, Vec3{0, 0, 0.5f}}) reflect(each, record, offset);
  VolumeCaches volumes(cache.bounds());
  for (const VolumePart part : {VolumePart::surfaces, VolumePart::media}) {
    const auto& records = file.volumes[static_cast<std::size_t>(part)];
    for (const VolumeRecord& record : records) volumes.of(part).insert(record);
    for (const VolumeRecord& record : records)
      for (const Vec3& offset : {Vec3{}, Vec3{0.5f, 0, 0}, Vec3{0, 0, 0.5f}}) scatter(volumes.of(part), record, offset);
  }
  write_records(path, file);
  if (content(path) != bytes) std::abort();
}

void read(const std::string& bytes) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("fuzz_record_file." + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    use(path, bytes);
  } catch (const UserError&) {
  }
  std::filesystem::remove(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  if (size >= 8) read(isophote::test::sign_record_file(bytes));
  return 0;
}
