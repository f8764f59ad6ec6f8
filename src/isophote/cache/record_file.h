#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isophote/validity/volume_record.h"

namespace isophote {

/// What a record file holds: the records, and what they were made for.
struct RecordFile {
  std::uint64_t scene = 0;  ///< hash of the scene
  std::string settings;     ///< lines `key=value` of everything that shaped the records
  Pilot pilot{};            ///< of the picture they were made for
  float threshold = 1;      ///< that gave their footprints: after refinement, less than the settings say
  std::vector<Record> records;
  Basis basis = Basis::hemispherical;  ///< of the radiance
  std::vector<RadianceRecord> radiance{};
  std::array<std::vector<VolumeRecord>, 2> volumes{};  ///< by VolumePart
};

/// Writes a versioned, little-endian, checksummed file, complete or not at all. Throws UserError.
void write_records(const std::string& path, const RecordFile& file);

/// Throws UserError `PATH: reason` for anything but a whole, unharmed file of this version with finite, usable records.
RecordFile read_records(const std::string& path);

/// Throws UserError `PATH: reason` where the file's scene or settings are not those given; names the first setting that
/// differs.
void require_match(const std::string& path, const RecordFile& file, std::uint64_t scene, const std::string& settings);

}  // namespace isophote
